/* FMI 2.0: rates of inputs and outputs. */
#include "calls.h"

#include "fmi2Functions.h"

#include <math.h>

/* Name of a variable, or its value reference where there is none. */
static void add_name(const Instance *it, fmi2ValueReference reference, Text *text)
{
    if (reference < it->n_variables) {
        text_add(text, model_text(&it->model, it->model.variables[reference].name), NULL);
    } else {
        text_add(text, "value reference ", NULL);
        text_add_whole(text, reference);
    }
}

/* Whether the arrays of a call about derivatives are there. */
static fmi2Status has_arrays(Instance *it, Call call, const void *vr, const void *order, const void *value)
{
    if (!vr) return call_lacks(it, call, "vr");
    if (!order) return call_lacks(it, call, "order");
    if (!value) return call_lacks(it, call, "value");
    return fmi2OK;
}

/* Whether a derivative is of first order, and of a Real with that causality. */
static fmi2Status is_rate(Instance *it, fmi2ValueReference reference, fmi2Integer order, unsigned causality)
{
    Text text = {0};
    if (reference >= it->n_variables || it->slots[reference].type != TYPE_REAL ||
        it->slots[reference].causality != causality) {
        add_name(it, reference, &text);
        text_add(&text, causality == CAUSALITY_INPUT ? " is not an input" : " is not an output",
                 ": it has no derivative", NULL);
        return instance_fail(it, &text);
    }
    if (order == 1) return fmi2OK;
    add_name(it, reference, &text);
    text_add(&text, ": derivatives of order ", order < 0 ? "-" : NULL, NULL);
    text_add_whole(&text, order < 0 ? 0ULL - (unsigned long long)order : (unsigned long long)order);
    text_add(&text, " are not supported, only of order 1", NULL);
    return instance_fail(it, &text);
}

/* Set the rate of one input. */
static fmi2Status take_rate(Instance *it, fmi2ValueReference reference, fmi2Integer order, double rate)
{
    fmi2Status status = is_rate(it, reference, order, CAUSALITY_INPUT);
    Text text = {0};
    if (status != fmi2OK) return status;
    if (isfinite(rate)) {
        double *at = &it->rates[it->model.variables[reference].index];
        if (rate != *at) instance_changed(it);
        *at = rate;
        it->rated = 1;
        return fmi2OK;
    }
    text_add(&text, "rate not taken: that of ", NULL);
    add_name(it, reference, &text);
    text_add(&text, " = ", NULL);
    text_add_number(&text, rate, 0);
    text_add(&text, " is refused: it must be finite", NULL);
    return instance_refuse(it, fmi2Discard, &text);
}

/* Set rates of inputs for the next step. */
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    Instance *it = c;
    fmi2Status status = fmi2OK;
    size_t i;
    if (!call_allowed(it, CALL_INPUT_DERIVATIVES)) return call_refused(it, CALL_INPUT_DERIVATIVES);
    if (nvr) status = has_arrays(it, CALL_INPUT_DERIVATIVES, vr, order, value);
    for (i = 0; i < nvr && status != fmi2Error; i++) {
        fmi2Status one = take_rate(it, vr[i], order[i], value[i]);
        if (one > status) status = one;
    }
    return status;
}

/* Mean rates of outputs over the last step. */
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[])
{
    Instance *it = c;
    fmi2Status status = fmi2OK;
    size_t i;
    if (!call_allowed(it, CALL_OUTPUT_DERIVATIVES)) return call_refused(it, CALL_OUTPUT_DERIVATIVES);
    if (nvr) status = has_arrays(it, CALL_OUTPUT_DERIVATIVES, vr, order, value);
    instance_track(it);
    for (i = 0; i < nvr && status != fmi2Error; i++) {
        status = is_rate(it, vr[i], order[i], CAUSALITY_OUTPUT);
        value[i] = 0.0;
        if (status == fmi2OK && it->slots[vr[i]].computed && it->last_step > 0.0) {
            uint32_t at = it->model.variables[vr[i]].index;
            value[i] = (it->z[at] - it->before_z[at]) / it->last_step;
        }
    }
    return status;
}
