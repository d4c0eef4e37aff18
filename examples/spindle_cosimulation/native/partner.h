/* What the FMI frame (partner.c) and a model (motor.c, thermal.c) know of each other. Together they are an
 * FMU for co-simulation with Real variables only. */
#ifndef PARTNER_H
#define PARTNER_H

#include <stddef.h>

/* Written by build.py from the description: PARTNER_GUID, one name per value reference (HEAT_OIL for
 * heat.oil), N_VARIABLES, N_HIDDEN (numbers that a model remembers beside its variables), PARTNER_VARIABLES
 * for a table of Variable, and the model's own tables. */
#include "variables.h"

enum { INPUT, OUTPUT, PARAMETER };

typedef struct Variable {
    const char *name;
    int causality;
    double start;
} Variable;

/* Set outputs and what is remembered to the begin of a run at time `begin` (s). May be called again. */
void model_initialise(double *v, double *hidden, double begin);

/* Advance from `time` by `size` (s). NULL, or why not: then nothing has changed. */
const char *model_step(double *v, double *hidden, double time, double size);

#endif
