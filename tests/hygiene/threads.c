/* Eight threads solve the same poses at once: each gets, to the last bit, what one alone gets. */
#include "calls.h"

#include <pthread.h>

enum { POSES = 64, THREADS = 8, ROUNDS = ROUNDS_EACH };

typedef struct {
    question questions[POSES];
    int counts[POSES], many[POSES], reached;
    double q[POSES][MAXIMUM][JOINTS], all[POSES * MAXIMUM][JOINTS];
    double T[POSES * 16], input[POSES];
} work;

static void solve(work *w)
{
    unsigned long long state = 3;
    memset(w, 0, sizeof *w);
    for (int i = 0; i < POSES; ++i) {
        w->questions[i] = ordinary(&state);
        if (i % 4 == 1) {
            for (int j = 0; j < JOINTS; ++j) {
                w->questions[i].reference[j] = (j % 2 ? 0.0 : 0.5) * (i % 3);
            }
            F(_fk)(w->questions[i].reference, &w->questions[i].p, w->questions[i].T);
        }
        w->counts[i] = F(_ik_near)(w->questions[i].T, &w->questions[i].p, w->questions[i].reference, w->q[i]);
        for (int k = w->counts[i] < 0 ? 0 : w->counts[i]; k < MAXIMUM; ++k) {
            memset(w->q[i][k], 0, sizeof w->q[i][k]); /* rows beyond the number are undefined */
        }
        memcpy(w->T + 16 * i, w->questions[i].T, 16 * sizeof(double));
        w->input[i] = w->questions[0].reference[0];
    }
    w->reached = ask_batch(w->questions, POSES, w->T, w->input, w->all, w->many);
    for (int i = 0; i < POSES; ++i) {
        for (int k = w->many[i] < 0 ? 0 : w->many[i]; k < MAXIMUM; ++k) {
            memset(w->all[i * MAXIMUM + k], 0, sizeof w->all[0]);
        }
    }
}

static work *alone;

static void *run(void *given)
{
    work *own = (work *)given;
    for (int round = 0; round < ROUNDS; ++round) {
        solve(own);
        HOLDS(own->reached == alone->reached);
        HOLDS(memcmp(own->counts, alone->counts, sizeof own->counts) == 0);
        HOLDS(memcmp(own->many, alone->many, sizeof own->many) == 0);
        HOLDS(memcmp(own->q, alone->q, sizeof own->q) == 0);
        HOLDS(memcmp(own->all, alone->all, sizeof own->all) == 0);
    }
    return NULL;
}

int main(void)
{
    pthread_t threads[THREADS];
    work *each = (work *)calloc(THREADS + 1, sizeof *each);
    HOLDS(each != NULL);
    alone = each + THREADS;
    solve(alone);
    HOLDS(alone->reached > 0);
    for (int i = 0; i < THREADS; ++i) {
        HOLDS(pthread_create(threads + i, NULL, run, each + i) == 0);
    }
    for (int i = 0; i < THREADS; ++i) {
        HOLDS(pthread_join(threads[i], NULL) == 0);
    }
    free(each);
    printf("%d poses reached\n", ROUNDS * POSES);
    return 0;
}
