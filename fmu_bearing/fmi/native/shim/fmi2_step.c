/* FMI 2.0: communication steps, derivatives in time, and how the last step went. */
#include "calls.h"

#include "fmi2Functions.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Refuse a step: before it, as the master called it wrongly, or after it, as the engine did not get there. */
static void add_step(Text *text, double time, double size)
{
    text_add(text, "step from ", NULL);
    text_add_number(text, time, 0);
    text_add(text, " s by ", NULL);
    text_add_number(text, size, 0);
    text_add(text, " s refused: ", NULL);
}

/* Refuse a step that is not a positive, finite number of seconds. */
static fmi2Status no_step(Instance *it, double time, double size)
{
    Text text = {0};
    add_step(&text, time, size);
    text_add(&text, "the step ", NULL);
    text_add_number(&text, size, 0);
    text_add(&text, " s is not a positive, finite number", NULL);
    return instance_fail(it, &text);
}

/* Refuse a step that begins at another time than the one reached. */
static fmi2Status wrong_time(Instance *it, double time, double size)
{
    Text text = {0};
    add_step(&text, time, size);
    text_add(&text, "the communication time ", NULL);
    text_add_number(&text, time, 0);
    text_add(&text, " s is not the time reached, ", NULL);
    text_add_number(&text, it->time, 0);
    text_add(&text, " s", NULL);
    return instance_fail(it, &text);
}

/* Go back to where the step began, and say why it did not succeed. */
static fmi2Status undo(Instance *it, double time, double size, int32_t status)
{
    Text text = {0};
    it->reached = *it->engine_time;
    memcpy(it->s, it->kept_s, it->bytes_s);
    if (!it->tracks) it->last_step = 0.0; /* the copy was of this step's begin: nothing to look back on */
    add_step(&text, time, size);
    text_add(&text, "step of ", NULL);
    text_add_number(&text, size, 0);
    text_add(&text, " s from t = ", NULL);
    text_add_number(&text, *it->engine_time, 9);
    text_add(&text, " s (reached ", NULL);
    text_add_number(&text, it->reached, 9);
    text_add(&text, " s): ", NULL);
    model_add_reason(&it->model, status, &text);
    text_add(&text, "; ", NULL);
    instance_add_inputs(it, &text);
    return instance_refuse(it, fmi2Discard, &text);
}

/* Let the engine step with these inputs; where that fails everything is as before. */
static inline fmi2Status advance(Instance *it, double time, double size, const double *inputs)
{
    int32_t status;
    memcpy(it->kept_s, it->s, it->bytes_s);
    if (it->tracks) memcpy(it->kept_z, it->z, it->bytes_z);
    status = it->step(it->p, inputs, it->s, it->z, it->w, it->sizes, size);
    if (status != 0) return undo(it, time, size, status);
    if (it->tracks) {
        double *spare = it->before_z;
        it->before_z = it->kept_z;
        it->kept_z = spare;
    }
    it->last_step = size;
    it->reached = it->time = time + size;
    return fmi2OK;
}

/* Whether inputs that have rates end the step within their ranges. */
static int ends_in_range(Instance *it, double size, Text *why)
{
    uint64_t i;
    for (i = 0; i < it->n_variables; i++) {
        const ModelVariable *variable = &it->model.variables[i];
        double rate = variable->array == ARRAY_U ? it->rates[variable->index] : 0.0;
        if (rate != 0.0 && !instance_may_have(it, i, it->u[variable->index] + rate * size, why)) return 0;
    }
    return 1;
}

/* Step with rates: a ramped input is at its end value as the engine ramps it, others in their middle. */
static fmi2Status ramped(Instance *it, double time, double size)
{
    const ModelHead *head = it->model.head;
    fmi2Status status;
    Text why = {0};
    uint64_t i;
    if (!ends_in_range(it, size, &why)) {
        Text text = {0};
        add_step(&text, time, size);
        text_add(&text, "with its rate an input would leave its range: ", text_string(&why), NULL);
        text_free(&why);
        it->reached = it->time;
        return instance_refuse(it, fmi2Discard, &text);
    }
    for (i = 0; i < head->n_u; i++) {
        double share = i == head->ramped ? 1.0 : 0.5;
        it->held[i] = it->u[i] + share * (it->rates[i] * size);
    }
    status = advance(it, time, size, it->held);
    if (status != fmi2OK) return status;
    for (i = 0; i < head->n_u; i++) it->u[i] += it->rates[i] * size;
    memset(it->rates, 0, (size_t)head->n_u * sizeof(double));
    it->rated = 0;
    return fmi2OK;
}

/* Advance by a communication step. */
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real size, fmi2Boolean no_set_state)
{
    Instance *it = c;
    (void)no_set_state;
    if (!call_allowed(it, CALL_DO_STEP)) return call_refused(it, CALL_DO_STEP);
    if (!(size > 0.0 && size <= DBL_MAX)) return no_step(it, time, size);
    /* masters count time in different ways: allow what adding up steps may lose */
    if (!(fabs(time - it->time) <= 1e-9 + 1e-12 * fabs(it->time))) return wrong_time(it, time, size);
    if (it->rated) return ramped(it, time, size);
    return advance(it, time, size, it->u);
}

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
        it->rates[it->model.variables[reference].index] = rate;
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

/* Refuse to cancel: steps end before doStep returns. */
fmi2Status fmi2CancelStep(fmi2Component c)
{
    Instance *it = c;
    Text text = {0};
    if (!call_allowed(it, CALL_CANCEL_STEP)) return call_refused(it, CALL_CANCEL_STEP);
    text_add(&text, "cancelStep: no step is running, as doStep returns only when its step has ended", NULL);
    return instance_fail(it, &text);
}

/* Refuse partial derivatives. */
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[], size_t n_unknowns,
                                        const fmi2ValueReference knowns[], size_t n_knowns,
                                        const fmi2Real known[], fmi2Real unknown[])
{
    Instance *it = c;
    Text text = {0};
    (void)unknowns, (void)n_unknowns, (void)knowns, (void)n_knowns, (void)known, (void)unknown;
    if (!call_allowed(it, CALL_DIRECTIONAL_DERIVATIVE)) return call_refused(it, CALL_DIRECTIONAL_DERIVATIVE);
    text_add(&text, "getDirectionalDerivative: this FMU does not provide directional derivatives", NULL);
    return instance_fail(it, &text);
}

/* Say that a status is not to be had. */
static fmi2Status no_status(Instance *it, const char *what)
{
    Text text = {0};
    text_add(&text, "getStatus: ", what, NULL);
    return instance_refuse(it, fmi2Discard, &text);
}

static const char NOT_PENDING[] = "no step is pending, as doStep returns only when its step has ended";
static const char NOT_OF_THIS_TYPE[] = "there is no status of that kind and type";

/* How the last step went: known from doStep itself. */
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    Instance *it = c;
    if (!call_allowed(it, CALL_STATUS)) return call_refused(it, CALL_STATUS);
    if (!value) return call_lacks(it, CALL_STATUS, "value");
    return no_status(it, kind == fmi2DoStepStatus ? NOT_PENDING : NOT_OF_THIS_TYPE);
}

/* Time until which the last step succeeded. */
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    Instance *it = c;
    if (!call_allowed(it, CALL_STATUS)) return call_refused(it, CALL_STATUS);
    if (!value) return call_lacks(it, CALL_STATUS, "value");
    if (kind != fmi2LastSuccessfulTime) return no_status(it, NOT_OF_THIS_TYPE);
    *value = it->reached;
    return fmi2OK;
}

/* No status is an Integer. */
fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    Instance *it = c;
    (void)kind;
    if (!call_allowed(it, CALL_STATUS)) return call_refused(it, CALL_STATUS);
    if (!value) return call_lacks(it, CALL_STATUS, "value");
    return no_status(it, NOT_OF_THIS_TYPE);
}

/* Whether the slave wants to end: never. */
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    Instance *it = c;
    if (!call_allowed(it, CALL_STATUS)) return call_refused(it, CALL_STATUS);
    if (!value) return call_lacks(it, CALL_STATUS, "value");
    if (kind != fmi2Terminated) return no_status(it, NOT_OF_THIS_TYPE);
    *value = fmi2False;
    return fmi2OK;
}

/* What a pending step waits for: none is ever pending. */
fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    Instance *it = c;
    if (!call_allowed(it, CALL_STATUS)) return call_refused(it, CALL_STATUS);
    if (!value) return call_lacks(it, CALL_STATUS, "value");
    return no_status(it, kind == fmi2PendingStatus ? NOT_PENDING : NOT_OF_THIS_TYPE);
}
