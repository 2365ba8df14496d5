/* What the programs beside this file share. Compiled with -DARM=ur5 -DHEADER='"ur5.h"' and the numbers that building.py gives:
 * every function of the arm under a short name, and checks that end the program with the line that failed. */
#include HEADER

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef REAL /* the type of the arm's numbers, where it is another one */
#define double REAL
#endif

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
#define F(name) JOIN(ARM, name)

typedef F(_params) params;
typedef F(_mark) mark;
typedef F(_solutions) solutions;
typedef struct {
    double T[16];
    params p;
    double reference[JOINTS];
} question;

#define HOLDS(condition) \
    do { \
        if (!(condition)) { \
            fprintf(stderr, "line %d: %s\n", __LINE__, #condition); \
            exit(1); \
        } \
    } while (0)

/* A number in (-1, 1), the same sequence everywhere (Knuth's MMIX generator). */
static double random_number(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(long long)(*state >> 11) / 4503599627370496.0 - 1.0;
}

/* ik_batch, whose inputs come as arrays. */
static int ask_batch(const question *a, int n, const double *T, const double *input, double (*q)[JOINTS], int *counts)
{
    (void)input;
#if INPUTS == 0
    return F(_ik_batch)(T, n, &a->p, a->reference, q, counts);
#elif INPUTS == 1
    return F(_ik_batch)(T, n, &a->p, a->reference, input, q, counts);
#else
    return F(_ik_batch)(T, n, &a->p, a->reference, input, input, q, counts);
#endif
}

/* A pose that the arm reaches, with parameters that it may have. */
static question ordinary(unsigned long long *state)
{
    static const double values[sizeof(params) / sizeof(double)] = VALUES;
    question a;
    memcpy(&a.p, values, sizeof a.p);
    for (int i = 0; i < JOINTS; ++i) {
        a.reference[i] = 3.0 * random_number(state);
    }
    double *field = (double *)&a.p;
    for (int i = 0; i < INPUTS; ++i) {
        field[FIELDS - INPUTS + i] = a.reference[(int[])LOCKED[i]];
    }
    F(_fk)(a.reference, &a.p, a.T);
    return a;
}
