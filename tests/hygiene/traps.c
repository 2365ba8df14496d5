/* Floating-point traps on: the calls for one pose run through at every finite pose, reached or not, singular or not.
 * What traps ends the program by SIGFPE. */
#define _GNU_SOURCE /* feenableexcept */
#include <fenv.h>

#include "calls.h"

enum { ROUNDS = 400 * ROUNDS_EACH };

static long reached = 0;

static void ask(const question *a)
{
    static double q[MAXIMUM][JOINTS], wound[16 * MAXIMUM][JOINTS], J[6 * JOINTS];
    static mark marks[16 * MAXIMUM];
    static solutions out;
    double T[16];
    F(_fk)(a->reference, &a->p, T);
    F(_jacobian)(a->reference, &a->p, J);
    reached += F(_ik_near)(a->T, &a->p, a->reference, q) > 0;
    F(_solve)(a->T, &a->p, a->reference, &out);
    F(_within)(a->T, &a->p, a->reference, NULL, NULL, 16 * MAXIMUM, wound, marks);
    F(_nearest)(a->T, &a->p, a->reference, NULL, NULL, NULL, q[0]);
}

int main(void)
{
    unsigned long long state = 11;
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    for (int i = 0; i < ROUNDS; ++i) {
        question a = ordinary(&state), turned = a, far = a;
        ask(&a);
        for (int j = 0; j < JOINTS; ++j) {
            if (i >> j & 1) {
                turned.reference[j] = 1.5707963267948966 * (double)(i % 5 - 2);
            }
        }
        double *field = (double *)&turned.p;
        for (int k = 0; k < INPUTS; ++k) {
            field[FIELDS - INPUTS + k] = turned.reference[(int[])LOCKED[k]];
        }
        F(_fk)(turned.reference, &turned.p, turned.T);
        ask(&turned);
        for (int k = 3; k < 12; k += 4) {
            far.T[k] *= i % 2 ? 3.0 : 1e6;
        }
        ask(&far);
    }
    printf("no trap, %ld poses reached\n", reached);
    return 0;
}
