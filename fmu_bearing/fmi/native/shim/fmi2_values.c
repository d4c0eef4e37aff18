/* FMI 2.0: values of variables. */
#include "calls.h"

#include "fmi2Functions.h"

#include <limits.h>
#include <math.h>

static const char *const TYPE_NAMES[] = {"Real", "Integer", "Boolean", "String"};

/* Refuse what has no such value reference. */
static fmi2Status strange(Instance *it, fmi2ValueReference reference, unsigned type)
{
    Text text = {0};
    text_add(&text, "there is no ", TYPE_NAMES[type], " with value reference ", NULL);
    text_add_whole(&text, reference);
    return instance_fail(it, &text);
}

/* Whether a value reference is that of a variable of the type. */
static inline int is_known(const Instance *it, fmi2ValueReference reference, unsigned type)
{
    return reference < it->n_variables && it->slots[reference].type == type;
}

/* Whether values can be read: allowed, and with room for them. */
static fmi2Status may_get(Instance *it, const void *references, size_t count, const void *values)
{
    if (!call_allowed(it, CALL_GET)) return call_refused(it, CALL_GET);
    if (count && !references) return call_lacks(it, CALL_GET, "vr");
    if (count && !values) return call_lacks(it, CALL_GET, "value");
    return fmi2OK;
}

/* Say once that an output read before initialisation is not computed yet. FMI does not allow the call, but an
 * error would end a host that shows values while it loads. */
static fmi2Status too_early(Instance *it, fmi2ValueReference reference)
{
    Text text = {0};
    it->early = 1;
    text_add(&text, model_text(&it->model, it->model.variables[reference].name),
             " is read before initialisation: outputs are 0 until fmi2EnterInitializationMode is called", NULL);
    instance_refuse(it, fmi2Warning, &text); /* said, not answered: some masters go on after fmi2OK alone */
    return fmi2OK;
}

/* In initialisation, outputs asked for are values at its end: settle the engine if one is among them. */
static fmi2Status settle_for(Instance *it, const fmi2ValueReference *references, size_t count)
{
    size_t i;
    int before = it->phase == PHASE_INSTANTIATED;
    if (before ? it->early : it->phase != PHASE_INITIALISING || it->settled) return fmi2OK;
    for (i = 0; i < count; i++) {
        if (references[i] < it->n_variables && it->slots[references[i]].computed) {
            if (before) return too_early(it, references[i]);
            return instance_settle(it, fmi2Error); /* other inputs may have an equilibrium: it goes on */
        }
    }
    return fmi2OK;
}

/* The worse of two answers. */
static fmi2Status worse(fmi2Status a, fmi2Status b)
{
    return a > b ? a : b;
}

/* Read Reals. */
fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[])
{
    Instance *it = c;
    fmi2Status status = may_get(it, vr, nvr, value);
    size_t i;
    if (status != fmi2OK) return status;
    status = settle_for(it, vr, nvr);
    for (i = 0; i < nvr; i++) {
        if (is_known(it, vr[i], TYPE_REAL)) {
            value[i] = *it->slots[vr[i]].at;
        } else {
            value[i] = 0.0;
            status = strange(it, vr[i], TYPE_REAL);
        }
    }
    return status;
}

/* A whole number as an int, at its bounds where it is beyond them. */
static fmi2Integer whole(double value)
{
    if (!(value > INT_MIN)) return INT_MIN;
    return value < INT_MAX ? (fmi2Integer)value : INT_MAX;
}

/* Read Integers and Enumerations. */
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[])
{
    Instance *it = c;
    fmi2Status status = may_get(it, vr, nvr, value);
    size_t i;
    if (status != fmi2OK) return status;
    status = settle_for(it, vr, nvr);
    for (i = 0; i < nvr; i++) {
        if (is_known(it, vr[i], TYPE_INTEGER)) {
            value[i] = whole(*it->slots[vr[i]].at);
        } else {
            value[i] = 0;
            status = strange(it, vr[i], TYPE_INTEGER);
        }
    }
    return status;
}

/* Read Booleans. */
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[])
{
    Instance *it = c;
    fmi2Status status = may_get(it, vr, nvr, value);
    size_t i;
    if (status != fmi2OK) return status;
    status = settle_for(it, vr, nvr);
    for (i = 0; i < nvr; i++) {
        if (is_known(it, vr[i], TYPE_BOOLEAN)) {
            value[i] = *it->slots[vr[i]].at != 0.0;
        } else {
            value[i] = fmi2False;
            status = strange(it, vr[i], TYPE_BOOLEAN);
        }
    }
    return status;
}

/* Read Strings, all of them constants. */
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[])
{
    Instance *it = c;
    fmi2Status status = may_get(it, vr, nvr, value);
    size_t i;
    if (status != fmi2OK) return status;
    for (i = 0; i < nvr; i++) {
        if (is_known(it, vr[i], TYPE_STRING)) {
            value[i] = model_text(&it->model, it->model.variables[vr[i]].text);
        } else {
            value[i] = "";
            status = strange(it, vr[i], TYPE_STRING);
        }
    }
    return status;
}

/* Refuse to set what is computed, or a parameter between steps. */
static fmi2Status not_now(Instance *it, fmi2ValueReference reference, double value, const char *reason)
{
    const ModelVariable *variable = &it->model.variables[reference];
    Text text = {0};
    text_add(&text, "value not taken: ", model_text(&it->model, variable->name), NULL);
    if (variable->type != TYPE_STRING) {
        text_add(&text, " = ", NULL);
        text_add_number(&text, value, 0);
    }
    text_add(&text, " is refused: ", reason, NULL);
    return instance_fail(it, &text);
}

/* Whether a value out of range waits for a better one. There are masters that set every input to 0 while they
 * load, whatever its range, and give it its first true value in or after initialisation. */
static int may_wait(const Instance *it, const Slot *slot, double value)
{
    return slot->causality == CAUSALITY_INPUT && isfinite(value) && it->phase != PHASE_STEPPING;
}

/* Keep a value that waits, and say what follows. */
static fmi2Status wait_for(Instance *it, fmi2ValueReference reference, double value, Text *why)
{
    Text said = {0};
    instance_keep_waiting(it, reference, value);
    it->settled = 0;
    text_add(&said, "value not taken yet: ", text_string(why), "; initialisation uses the start value ", NULL);
    text_add_number(&said, it->u[it->model.variables[reference].index], 0);
    text_add(&said, ", and steps are refused until a value in the range comes", NULL);
    text_free(why);
    instance_refuse(it, fmi2Warning, &said); /* said, not answered: some masters go on after fmi2OK alone */
    return fmi2OK;
}

/* Take one number, or say why not. */
static fmi2Status take(Instance *it, fmi2ValueReference reference, unsigned type, double value)
{
    const Slot *slot;
    Text text = {0};
    if (!is_known(it, reference, type)) return strange(it, reference, type);
    slot = &it->slots[reference];
    if (!slot->settable) return not_now(it, reference, value, "it is computed, not set");
    if (slot->fixed && it->phase != PHASE_INSTANTIATED && it->phase != PHASE_INITIALISING) {
        if (value == *slot->at) return fmi2OK;
        return not_now(it, reference, value, "parameters cannot be set between steps");
    }
    if (!instance_may_have(it, reference, value, &text)) {
        Text said = {0};
        if (may_wait(it, slot, value)) return wait_for(it, reference, value, &text);
        text_add(&said, "value not taken: ", text_string(&text), NULL);
        text_free(&text);
        return instance_refuse(it, fmi2Discard, &said);
    }
    if (value != *slot->at) instance_changed(it);
    *slot->at = value;
    if (it->model.variables[reference].array == ARRAY_P) instance_forget(it); /* see `note`: inputs are kept alone */
    instance_end_waiting(it, reference);
    if (it->phase != PHASE_STEPPING) it->settled = 0;
    return fmi2OK;
}

/* Whether values can be set: allowed, and they are there. */
static fmi2Status may_set(Instance *it, const void *references, size_t count, const void *values)
{
    if (!call_allowed(it, CALL_SET)) return call_refused(it, CALL_SET);
    if (count && !references) return call_lacks(it, CALL_SET, "vr");
    if (count && !values) return call_lacks(it, CALL_SET, "value");
    return fmi2OK;
}

/* Set Reals; one that is refused does not keep the others from being taken. */
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[])
{
    Instance *it = c;
    fmi2Status status = may_set(it, vr, nvr, value);
    size_t i;
    if (status != fmi2OK) return status;
    for (i = 0; i < nvr; i++) status = worse(status, take(it, vr[i], TYPE_REAL, value[i]));
    return status;
}

/* Set Integers. */
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[])
{
    Instance *it = c;
    fmi2Status status = may_set(it, vr, nvr, value);
    size_t i;
    if (status != fmi2OK) return status;
    for (i = 0; i < nvr; i++) status = worse(status, take(it, vr[i], TYPE_INTEGER, value[i]));
    return status;
}

/* Set Booleans. */
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Boolean value[])
{
    Instance *it = c;
    fmi2Status status = may_set(it, vr, nvr, value);
    size_t i;
    if (status != fmi2OK) return status;
    for (i = 0; i < nvr; i++) status = worse(status, take(it, vr[i], TYPE_BOOLEAN, value[i] != fmi2False));
    return status;
}

/* Refuse to set Strings: all are constants. */
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[])
{
    Instance *it = c;
    fmi2Status status = may_set(it, vr, nvr, value);
    size_t i;
    if (status != fmi2OK) return status;
    for (i = 0; i < nvr; i++) status = worse(status, take(it, vr[i], TYPE_STRING, 0.0));
    return status;
}
