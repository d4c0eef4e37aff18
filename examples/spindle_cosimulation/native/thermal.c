/* Thermal network of spindle bearings: the equations of thermal.py, in the same order of operations. */
#include "partner.h"

#include <math.h>

#define MAX_SUB_STEP 1e-3 /* s */

/* From `tables` of thermal.py: value references; heat -1 where none enters, other -1 for the ambient. */
static const struct Lump {
    int temperature, capacity, heat;
} LUMPS[] = {PARTNER_LUMPS};
static const struct Link {
    int one, other, conductance;
} LINKS[] = {PARTNER_LINKS};
enum { N_LUMPS = sizeof LUMPS / sizeof LUMPS[0], N_LINKS = sizeof LINKS / sizeof LINKS[0] };
enum { SOLVED_STEP, INVERSE }; /* of the matrix for that step, row by row */

/* Capacities plus step times conductances: the matrix of an implicit Euler step. */
static void fill_matrix(const double *v, double h, double matrix[N_LUMPS][2 * N_LUMPS])
{
    int i, j, k;
    for (i = 0; i < N_LUMPS; i++) {
        for (j = 0; j < 2 * N_LUMPS; j++) matrix[i][j] = 0.0;
        matrix[i][i] = v[LUMPS[i].capacity];
        matrix[i][N_LUMPS + i] = 1.0;
    }
    for (k = 0; k < N_LINKS; k++) {
        double flow = h * v[LINKS[k].conductance];
        i = LINKS[k].one;
        j = LINKS[k].other;
        matrix[i][i] += flow;
        if (j < 0) continue;
        matrix[j][j] += flow;
        matrix[i][j] -= flow;
        matrix[j][i] -= flow;
    }
}

/* Gauss-Jordan without pivoting: the matrix is symmetric and diagonally dominant. The left half of `rows` is
 * the matrix, the right half the unit matrix, which becomes the inverse. */
static void invert(double rows[N_LUMPS][2 * N_LUMPS], double *inverse)
{
    int i, j, k;
    for (i = 0; i < N_LUMPS; i++) {
        double pivot = rows[i][i];
        for (j = 0; j < 2 * N_LUMPS; j++) rows[i][j] /= pivot;
        for (k = 0; k < N_LUMPS; k++) {
            double factor = rows[k][i];
            if (k == i) continue;
            for (j = 0; j < 2 * N_LUMPS; j++) rows[k][j] -= factor * rows[i][j];
        }
    }
    for (i = 0; i < N_LUMPS; i++) {
        for (j = 0; j < N_LUMPS; j++) inverse[i * N_LUMPS + j] = rows[i][N_LUMPS + j];
    }
}

/* One implicit Euler step for the rises above ambient, with its energy balance. */
static void advance(double *v, const double *inverse, double h, const double *heats)
{
    double before[N_LUMPS], after[N_LUMPS], right[N_LUMPS], supplied = 0.0, gained = 0.0;
    int i, j, k;
    for (i = 0; i < N_LUMPS; i++) {
        before[i] = v[LUMPS[i].temperature] - v[AMBIENT_TEMPERATURE];
        right[i] = heats[i] * h + v[LUMPS[i].capacity] * before[i];
        supplied += heats[i];
    }
    for (i = 0; i < N_LUMPS; i++) {
        after[i] = 0.0;
        for (j = 0; j < N_LUMPS; j++) after[i] += inverse[i * N_LUMPS + j] * right[j];
        v[LUMPS[i].temperature] = v[AMBIENT_TEMPERATURE] + after[i];
        gained += v[LUMPS[i].capacity] * (after[i] - before[i]);
    }
    for (k = 0; k < N_LINKS; k++) {
        if (LINKS[k].other >= 0) continue;
        v[ENERGY_GIVEN_OFF] += h * after[LINKS[k].one] * v[LINKS[k].conductance];
    }
    v[ENERGY_SUPPLIED] += h * supplied;
    v[ENERGY_STORED] += gained;
}

void model_initialise(double *v, double *hidden, double begin)
{
    int i;
    (void)begin;
    for (i = 0; i < N_LUMPS; i++) v[LUMPS[i].temperature] = v[INITIAL_TEMPERATURE];
    v[ENERGY_SUPPLIED] = v[ENERGY_STORED] = v[ENERGY_GIVEN_OFF] = 0.0;
    hidden[SOLVED_STEP] = 0.0;
}

const char *model_step(double *v, double *hidden, double time, double size)
{
    double heats[N_LUMPS];
    double pieces = ceil(size / MAX_SUB_STEP * (1.0 - 1e-9)), sub_step = size / pieces, solved, apart, k;
    int i;
    (void)time;
    for (i = 0; i < N_LUMPS; i++) {
        heats[i] = LUMPS[i].heat < 0 ? 0.0 : v[LUMPS[i].heat];
        if (!(v[LUMPS[i].capacity] > 0.0)) return "a capacity is not positive";
    }
    solved = hidden[SOLVED_STEP];
    apart = fabs(sub_step - solved);
    /* Masters subtract times, so equal steps differ in the last digits: not worth a new matrix. */
    if (!(apart <= fabs(1e-10 * solved) || apart <= fabs(1e-10 * sub_step))) {
        double rows[N_LUMPS][2 * N_LUMPS];
        fill_matrix(v, sub_step, rows);
        invert(rows, hidden + INVERSE);
        hidden[SOLVED_STEP] = sub_step;
    }
    for (k = 0.0; k < pieces; k += 1.0) advance(v, hidden + INVERSE, hidden[SOLVED_STEP], heats);
    return NULL;
}
