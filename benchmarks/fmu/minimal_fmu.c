/* The least co-simulation FMU (FMI 2.0) that a careful author would write by hand, with an empty step.
 *
 * A measure of what calls cost: it checks what has to be checked (phase, step, time, value references,
 * pointers) and computes nothing. 8 inputs have the value references 0 to 7, 50 outputs those behind. */
#include "fmi2Functions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifndef GUID
#define GUID "{00000000-0000-0000-0000-000000000000}"
#endif

enum { INPUTS = 8, OUTPUTS = 50, VARIABLES = INPUTS + OUTPUTS };

typedef enum Phase { INSTANTIATED, INITIALISING, STEPPING, TERMINATED, FAILED } Phase;

/* What a state consists of. */
typedef struct Values {
    Phase phase;
    double time;
    double values[VARIABLES];
} Values;

typedef struct Instance {
    Values now;
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
    char name[64];
} Instance;

/* Report an error, after which only reset helps. */
static fmi2Status fail(Instance *it, const char *message)
{
    if (!it) return fmi2Error;
    it->now.phase = FAILED;
    if (it->logger) it->logger(it->environment, it->name, fmi2Error, "logStatusError", "%s", message);
    return fmi2Error;
}

/* Go from one phase to the next. */
static fmi2Status move(Instance *it, Phase from, Phase to)
{
    if (!it || it->now.phase != from) return fail(it, "call out of order");
    it->now.phase = to;
    return fmi2OK;
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[])
{
    (void)on, (void)n, (void)categories;
    return c ? fmi2OK : fmi2Error;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    Instance *it;
    (void)resources, (void)visible, (void)logging;
    if (!name || !functions || type != fmi2CoSimulation || !guid || strcmp(guid, GUID) != 0) return NULL;
    it = calloc(1, sizeof *it);
    if (!it) return NULL;
    it->logger = functions->logger;
    it->environment = functions->componentEnvironment;
    strncpy(it->name, name, sizeof it->name - 1);
    return it;
}

void fmi2FreeInstance(fmi2Component c)
{
    free(c);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop)
{
    Instance *it = c;
    (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
    if (!it || it->now.phase != INSTANTIATED) return fail(it, "setupExperiment out of order");
    it->now.time = start;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return move(c, INSTANTIATED, INITIALISING);
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    return move(c, INITIALISING, STEPPING);
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    return move(c, STEPPING, TERMINATED);
}

fmi2Status fmi2Reset(fmi2Component c)
{
    Instance *it = c;
    if (!it) return fmi2Error;
    memset(&it->now, 0, sizeof it->now);
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    Instance *it = c;
    size_t i;
    if (!it || (n && (!vr || !value))) return fail(it, "getReal without instance or arrays");
    for (i = 0; i < n; i++) {
        if (vr[i] >= VARIABLES) return fail(it, "getReal of an unknown value reference");
        value[i] = it->now.values[vr[i]];
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    Instance *it = c;
    size_t i;
    if (!it || it->now.phase > STEPPING || (n && (!vr || !value))) return fail(it, "setReal out of order");
    for (i = 0; i < n; i++) {
        if (vr[i] >= INPUTS) return fail(it, "setReal of what is no input");
        if (!isfinite(value[i])) return fmi2Discard;
        it->now.values[vr[i]] = value[i];
    }
    return fmi2OK;
}

/* Refuse values of a type that no variable has. */
static fmi2Status no_such(fmi2Component c, size_t n)
{
    return n ? fail(c, "there are Reals only") : fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer value[])
{
    (void)vr, (void)value;
    return no_such(c, n);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Boolean value[])
{
    (void)vr, (void)value;
    return no_such(c, n);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2String value[])
{
    (void)vr, (void)value;
    return no_such(c, n);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer value[])
{
    (void)vr, (void)value;
    return no_such(c, n);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Boolean value[])
{
    (void)vr, (void)value;
    return no_such(c, n);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2String value[])
{
    (void)vr, (void)value;
    return no_such(c, n);
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    Instance *it = c;
    if (!it || !state) return fmi2Error;
    if (!*state) *state = malloc(sizeof it->now);
    if (!*state) return fmi2Error;
    memcpy(*state, &it->now, sizeof it->now);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    Instance *it = c;
    if (!it || !state) return fmi2Error;
    memcpy(&it->now, state, sizeof it->now);
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    (void)c;
    if (!state) return fmi2OK;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    if (!c || !state || !size) return fmi2Error;
    *size = sizeof(Values);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    if (!c || !state || !bytes || size < sizeof(Values)) return fmi2Error;
    memcpy(bytes, state, sizeof(Values));
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    if (!c || !bytes || !state || size != sizeof(Values)) return fmi2Error;
    *state = malloc(sizeof(Values));
    if (!*state) return fmi2Error;
    memcpy(*state, bytes, sizeof(Values));
    return fmi2OK;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[], size_t n_unknowns,
                                        const fmi2ValueReference knowns[], size_t n_knowns,
                                        const fmi2Real known[], fmi2Real unknown[])
{
    (void)unknowns, (void)n_unknowns, (void)knowns, (void)n_knowns, (void)known, (void)unknown;
    return fail(c, "there are no directional derivatives");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    (void)vr, (void)n, (void)order, (void)value;
    return fail(c, "inputs are not interpolated");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[])
{
    (void)vr, (void)n, (void)order, (void)value;
    return fail(c, "there are no derivatives of outputs");
}

/* The empty step: checks, and the time. */
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real size, fmi2Boolean no_set_state)
{
    Instance *it = c;
    (void)no_set_state;
    if (!it || it->now.phase != STEPPING) return fail(it, "doStep out of order");
    if (!(size > 0.0) || !isfinite(size)) return fail(it, "the step is not a positive number");
    if (!(fabs(time - it->now.time) <= 1e-9 + 1e-12 * fabs(time))) return fail(it, "wrong communication time");
    it->now.time = time + size;
    return fmi2OK;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return fail(c, "no step is running");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)c, (void)kind, (void)value;
    return fmi2Discard;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    Instance *it = c;
    if (!it || !value || kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = it->now.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)c, (void)kind, (void)value;
    return fmi2Discard;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    (void)c, (void)kind, (void)value;
    return fmi2Discard;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)c, (void)kind, (void)value;
    return fmi2Discard;
}
