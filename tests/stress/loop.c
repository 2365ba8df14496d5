/* One call for many poses. HEADER names the robot's header, NAME its prefix, JOINTS, MOST and NUMBERS how many joints,
 * solutions and doubles in the struct of parameters it has. */
#include HEADER

#define JOIN(name, function) name##_##function
#define CALL(name, function) JOIN(name, function)

void stress_solve(const double T[], const double reference[], int n, const double given[], int inputs,
    const int places[], const int columns[], double q[][JOINTS], int counts[]);

/* ik_near of n poses; input i, at places[i] of the parameters, stands in column columns[i] of each reference. */
void stress_solve(const double T[], const double reference[], int n, const double given[], int inputs,
    const int places[], const int columns[], double q[][JOINTS], int counts[])
{
    union {
        CALL(NAME, params) p;
        double numbers[NUMBERS];
    } parameters;
    for (int i = 0; i < NUMBERS; ++i) {
        parameters.numbers[i] = given[i];
    }
    for (int k = 0; k < n; ++k) {
        const double *near = reference + k * JOINTS;
        for (int i = 0; i < inputs; ++i) {
            parameters.numbers[places[i]] = near[columns[i]];
        }
        counts[k] = CALL(NAME, ik_near)(T + 16 * k, &parameters.p, near, q + k * MOST);
    }
}
