/* Numbers that nobody should give, in every place: the calls return, say so by their status, write nothing beyond
 * their arrays and never hand out a solution that is not finite. */
#include "calls.h"

static const double WRONG[] = {
#ifdef REAL
    NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX, 1e38f, 2e19f, -2e19f, 9e14f, 1e10f, -1e9f,
    0.0f, -0.0f, FLT_MIN, 1.4e-45f, -1.4e-45f, 1e-40f, 1e-20f, 1e-10f, 1e-5f, 0.999f, 1.0005f,
#else
    NAN, INFINITY, -INFINITY, DBL_MAX, -DBL_MAX, 1e300, 1e155, -1e155, 1e149, 1e30, -1e9,
    0.0, -0.0, DBL_MIN, 4.9e-324, -4.9e-324, 1e-310, 1e-160, 1e-30, 1e-9, 0.999999, 1.0000005,
#endif
};
#define MOST ((int)(sizeof WRONG / sizeof WRONG[0]))

static long answered = 0, refused = 0;

/* Solutions are finite and as many as said; the row behind them is as it was. */
static void look(int count, int room, double (*q)[JOINTS])
{
    HOLDS(count <= room);
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < JOINTS; ++j) {
            HOLDS(isfinite(q[i][j]));
        }
    }
    answered += count > 0;
    refused += count < 0;
}

static int is_finite(const double *x, int n)
{
    for (int i = 0; i < n; ++i) {
        if (!isfinite(x[i])) {
            return 0;
        }
    }
    return 1;
}

/* Every function once, in arrays of exactly the size that is asked for. */
static void ask(const question *a, const double *lower, const double *upper, const double *weights, int batch)
{
    enum { POSES = 9, ROOM = MAXIMUM + 3 };
    double(*q)[JOINTS] = (double(*)[JOINTS])malloc(MAXIMUM * sizeof *q);
    double(*wound)[JOINTS] = (double(*)[JOINTS])malloc(ROOM * sizeof *wound);
    double(*all)[JOINTS] = (double(*)[JOINTS])malloc(POSES * MAXIMUM * sizeof *all);
    mark *marks = (mark *)malloc(MAXIMUM * sizeof *marks), *wound_marks = (mark *)malloc(ROOM * sizeof *wound_marks);
    double *T = (double *)malloc(POSES * 16 * sizeof *T), *J = (double *)malloc(6 * JOINTS * sizeof *J);
    double *input = (double *)malloc(POSES * sizeof *input);
    int *counts = (int *)malloc(POSES * sizeof *counts);
    solutions *out = (solutions *)malloc(sizeof *out);
    HOLDS(q && wound && all && marks && wound_marks && T && J && input && counts && out);
    F(_fk)(a->reference, &a->p, T);
    F(_jacobian)(a->reference, &a->p, J);
    const int given = is_finite(a->T, 16) && is_finite((const double *)&a->p, FIELDS);
    const int count = F(_ik_near)(a->T, &a->p, a->reference, q);
    HOLDS(given || count < 0);
    if (is_finite(a->reference, JOINTS)) {
        look(count, MAXIMUM, q);
        look(F(_ik_marked)(a->T, &a->p, a->reference, q, marks), MAXIMUM, q);
    }
    look(F(_ik)(a->T, &a->p, q), MAXIMUM, q);
    const int status = (int)F(_solve)(a->T, &a->p, a->reference, out);
    HOLDS(status == (int)out->status && status <= 2);
    HOLDS((given && is_finite(a->reference, JOINTS)) || status < 0);
    look(out->count, MAXIMUM, out->q);
    const int fitting = F(_within)(a->T, &a->p, a->reference, lower, upper, ROOM, wound,
                                   wound_marks);
    look(fitting < ROOM ? fitting : ROOM, ROOM, wound);
    const int nearest = (int)F(_nearest)(a->T, &a->p, a->reference, weights, lower, upper, q[0]);
    look(nearest > 0 ? 1 : nearest, 1, q);
    if (batch) {
        unsigned long long state = 7;
        for (int i = 0; i < POSES; ++i) {
            input[i] = a->reference[0];
            memcpy(T + 16 * i, (i == 4 ? *a : ordinary(&state)).T, 16 * sizeof *T);
        }
        ask_batch(a, POSES, T, input, all, counts);
        for (int i = 0; i < POSES; ++i) {
            memcpy(all[i], (i == 4 ? *a : ordinary(&state)).reference, sizeof all[i]);
        }
        F(_fk_batch)(all[0], POSES, &a->p, T);
    }
    free(q), free(wound), free(all), free(marks), free(wound_marks), free(T), free(J), free(input), free(counts), free(out);
}

int main(void)
{
    unsigned long long state = 1;
    for (int k = 0; k < MOST; ++k) {
        const double wrong = WRONG[k];
        for (int place = 0; place < 16; ++place) {
            question a = ordinary(&state);
            a.T[place] = wrong;
            ask(&a, NULL, NULL, NULL, place % 5 == k % 5);
        }
        for (int place = 0; place < FIELDS; ++place) {
            question a = ordinary(&state);
            ((double *)&a.p)[place] = wrong;
            ask(&a, NULL, NULL, NULL, 1);
            F(_fk)(a.reference, &a.p, a.T);
            ask(&a, NULL, NULL, NULL, 1);
        }
        question large = ordinary(&state), flat = large, far = large;
        for (int place = 0; place < FIELDS; ++place) {
            ((double *)&large.p)[place] *= wrong;
        }
        F(_fk)(large.reference, &large.p, large.T);
        ask(&large, NULL, NULL, NULL, 1);
        for (int place = 0; place < 16; ++place) {
            flat.T[place] *= wrong;
        }
        ask(&flat, NULL, NULL, NULL, 1);
        far.T[3] = far.T[7] = far.T[11] = wrong;
        ask(&far, NULL, NULL, NULL, 1);
        for (int place = 0; place < JOINTS; ++place) {
            question a = ordinary(&state);
            double lower[JOINTS], upper[JOINTS], weights[JOINTS];
            for (int j = 0; j < JOINTS; ++j) {
                lower[j] = -7.0, upper[j] = 7.0, weights[j] = 1.0;
            }
            weights[place] = wrong;
            ask(&a, lower, upper, weights, 0);
            weights[place] = 1.0, lower[place] = wrong;
            ask(&a, lower, upper, weights, 0);
            lower[place] = -fabs(wrong), upper[place] = fabs(wrong);
            ask(&a, lower, upper, NULL, 0);
            a.reference[place] = wrong;
            ask(&a, NULL, NULL, weights, 1);
        }
    }
    printf("%ld answered, %ld refused\n", answered, refused);
    return 0;
}
