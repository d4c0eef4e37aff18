/* FMI 2.0: how the last step went, and that none can be cancelled. */
#include "calls.h"

#include "fmi2Functions.h"

/* Refuse to cancel: steps end before doStep returns. The one call that a host may make from another thread while a
 * step is running: it reads the log's settings alone, and leaves the instance as it is. */
fmi2Status fmi2CancelStep(fmi2Component c)
{
    Instance *it = c;
    Text text = {0};
    if (!it) return fmi2Error;
    text_add(&text, "cancelStep: a step cannot be cancelled: doStep returns only when its step has ended", NULL);
    return instance_refuse(it, fmi2Error, &text);
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
