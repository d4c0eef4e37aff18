/* FMI 2.0: directional derivatives, which the mechanical port of a set has. */
#include "calls.h"
#include "float_mode.h"

#include "fmi2Functions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Whether the arrays of the call are there. */
static fmi2Status has_all(Instance *it, size_t n_unknowns, const void *unknowns, const void *unknown,
                          size_t n_knowns, const void *knowns, const void *known)
{
    if (n_unknowns && !unknowns) return call_lacks(it, CALL_DIRECTIONAL_DERIVATIVE, "vUnknown_ref");
    if (n_unknowns && !unknown) return call_lacks(it, CALL_DIRECTIONAL_DERIVATIVE, "dvUnknown");
    if (n_knowns && !knowns) return call_lacks(it, CALL_DIRECTIONAL_DERIVATIVE, "vKnown_ref");
    if (n_knowns && !known) return call_lacks(it, CALL_DIRECTIONAL_DERIVATIVE, "dvKnown");
    return fmi2OK;
}

/* Say that there is no such derivative; of no consequence for the model, which goes on. */
static fmi2Status not_known(Instance *it, const char *what)
{
    Text text = {0};
    text_add(&text, "getDirectionalDerivative: ", what, NULL);
    return instance_refuse(it, fmi2Error, &text);
}

/* Whether a value reference is of a Real of a causality which is in an array. */
static int stands_in(const Instance *it, fmi2ValueReference reference, unsigned causality, unsigned array)
{
    return reference < it->n_variables && it->slots[reference].type == TYPE_REAL &&
           it->slots[reference].causality == causality && it->model.variables[reference].array == array;
}

/* Ask the engine: behind the inputs `u` are their changes, behind the state `s` room for another. */
static int32_t ask(Instance *it, double *u, double *s, double *z)
{
    FloatMode host = float_mode_take();
    int32_t status;
    int64_t sizes[5];
    memcpy(sizes, it->sizes, sizeof sizes);
    sizes[1] *= 2;
    sizes[2] *= 2;
    memcpy(u, it->u, (size_t)it->sizes[1] * sizeof(double));
    memcpy(s, it->s, it->bytes_s);
    status = it->kernels->derivative(it->p, u, s, z, it->w, sizes, it->last_step);
    float_mode_give_back(host);
    return status;
}

/* Take the changes of inputs, ask, and give the changes of outputs. */
static fmi2Status answer(Instance *it, double *u, double *s, double *z, const fmi2ValueReference unknowns[],
                         size_t n_unknowns, const fmi2ValueReference knowns[], size_t n_knowns,
                         const fmi2Real known[], fmi2Real unknown[])
{
    size_t i;
    double *change = u + it->sizes[1];
    int32_t status;
    for (i = 0; i < n_knowns; i++) {
        if (!stands_in(it, knowns[i], CAUSALITY_INPUT, ARRAY_U)) {
            return not_known(it, "known variables are place and rate of the port alone");
        }
        change[it->model.variables[knowns[i]].index] += known[i];
    }
    status = ask(it, u, s, z);
    if (status != 0) return not_known(it, "the equations have none here");
    for (i = 0; i < n_unknowns; i++) {
        double value = NAN;
        if (stands_in(it, unknowns[i], CAUSALITY_OUTPUT, ARRAY_Z)) {
            value = z[it->model.variables[unknowns[i]].index];
        }
        if (!isfinite(value)) {
            return not_known(it, "known are force and moment of the port, by its place and rate alone");
        }
        unknown[i] = value;
    }
    return fmi2OK;
}

/* Partial derivatives of the port's force by its place and rate at the end of a step like the last one. */
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[], size_t n_unknowns,
                                        const fmi2ValueReference knowns[], size_t n_knowns,
                                        const fmi2Real known[], fmi2Real unknown[])
{
    Instance *it = c;
    Text text = {0};
    fmi2Status status;
    double *u, *s, *z;
    if (!call_allowed(it, CALL_DIRECTIONAL_DERIVATIVE)) return call_refused(it, CALL_DIRECTIONAL_DERIVATIVE);
    if (!it->model.head->n_led) {
        text_add(&text, "getDirectionalDerivative: this FMU does not provide directional derivatives", NULL);
        return instance_fail(it, &text);
    }
    status = has_all(it, n_unknowns, unknowns, unknown, n_knowns, knowns, known);
    if (status != fmi2OK) return status;
    if (it->phase == PHASE_INITIALISING && !it->settled) {
        status = instance_settle(it, fmi2Error); /* other inputs may have an equilibrium: it goes on */
        if (status != fmi2OK) return status;
    }
    if (!it->settled) return not_known(it, "it is known from initialisation on");
    u = calloc(2 * (size_t)it->sizes[1] + 1, sizeof(double));
    s = calloc(2 * (size_t)it->sizes[2] + 1, sizeof(double));
    z = calloc((size_t)it->sizes[3] + 1, sizeof(double));
    status = u && s && z
                 ? answer(it, u, s, z, unknowns, n_unknowns, knowns, n_knowns, known, unknown)
                 : not_known(it, "there is not enough memory");
    free(u);
    free(s);
    free(z);
    return status;
}
