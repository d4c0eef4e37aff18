/* A slave with one input and one output, y = sum of u h, and a fault chosen by -DFAULT=... */
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "fmi2Functions.h"

enum { NONE, CRASH, KEEPS, HANGS, SHARES, FORGETS, NAN_OUT, REPEATS, ENDS };

typedef struct {
    double u, y;
} Slave;

static double shared;

const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String place,
                              const fmi2CallbackFunctions *calls, fmi2Boolean visible, fmi2Boolean log) {
    (void)name, (void)type, (void)guid, (void)place, (void)calls, (void)visible, (void)log;
    Slave *one = calloc(1, sizeof *one);
    one->u = 1.0;
    return one;
}
void fmi2FreeInstance(fmi2Component c) { free(c); }

fmi2Status fmi2Reset(fmi2Component c) {
    Slave *one = c;
    one->u = 1.0;
    if (FAULT != KEEPS) one->y = 0.0;
    return fmi2OK;
}
fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[]) {
    Slave *one = c;
    for (size_t i = 0; i < n; i++) value[i] = vr[i] ? one->y : one->u;
    return fmi2OK;
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[]) {
    Slave *one = c;
    for (size_t i = 0; i < n; i++)
        if (vr[i] == 0) one->u = value[i];
    return fmi2OK;
}
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean final) {
    (void)time, (void)final;
    Slave *one = c;
    if (FAULT == CRASH) abort();
    if (FAULT == HANGS)
        for (;;) sleep(1);
    if (FAULT == REPEATS && one->u > 10.0) return fmi2Discard;
    if (FAULT == ENDS && one->u > 10.0) return one->y++ < 1.0 ? fmi2Discard : fmi2Error;
    if (!isfinite(one->u) || !(step > 0.0)) return fmi2Discard;
    one->y += one->u * step;
    if (FAULT == SHARES) one->y = shared += one->u * step;
    if (FAULT == NAN_OUT) one->y = 0.0 * INFINITY;
    return fmi2OK;
}
fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    Slave *kept = malloc(sizeof *kept);
    *kept = *(Slave *)c;
    if (FAULT == FORGETS) kept->y = 0.0;
    *state = kept;
    return fmi2OK;
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    *(Slave *)c = *(Slave *)state;
    return fmi2OK;
}
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    (void)c;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

#define FINE(name, ...) \
    fmi2Status name(__VA_ARGS__) { return fmi2OK; }
#define NOT(name, ...) \
    fmi2Status name(__VA_ARGS__) { return fmi2Error; }

FINE(fmi2SetDebugLogging, fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[])
FINE(fmi2SetupExperiment, fmi2Component c, fmi2Boolean d, fmi2Real t, fmi2Real a, fmi2Boolean s, fmi2Real b)
FINE(fmi2EnterInitializationMode, fmi2Component c)
FINE(fmi2ExitInitializationMode, fmi2Component c)
FINE(fmi2Terminate, fmi2Component c)
FINE(fmi2GetInteger, fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer value[])
FINE(fmi2GetBoolean, fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Boolean value[])
FINE(fmi2GetString, fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2String value[])
FINE(fmi2SetInteger, fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer value[])
FINE(fmi2SetBoolean, fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Boolean value[])
FINE(fmi2SetString, fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2String value[])
NOT(fmi2SerializedFMUstateSize, fmi2Component c, fmi2FMUstate s, size_t *size)
NOT(fmi2SerializeFMUstate, fmi2Component c, fmi2FMUstate s, fmi2Byte data[], size_t size)
NOT(fmi2DeSerializeFMUstate, fmi2Component c, const fmi2Byte data[], size_t size, fmi2FMUstate *s)
NOT(fmi2GetDirectionalDerivative, fmi2Component c, const fmi2ValueReference u[], size_t nu,
    const fmi2ValueReference k[], size_t nk, const fmi2Real dk[], fmi2Real du[])
NOT(fmi2SetRealInputDerivatives, fmi2Component c, const fmi2ValueReference vr[], size_t n,
    const fmi2Integer order[], const fmi2Real value[])
NOT(fmi2GetRealOutputDerivatives, fmi2Component c, const fmi2ValueReference vr[], size_t n,
    const fmi2Integer order[], fmi2Real value[])
NOT(fmi2CancelStep, fmi2Component c)
NOT(fmi2GetStatus, fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
NOT(fmi2GetRealStatus, fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
NOT(fmi2GetIntegerStatus, fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
NOT(fmi2GetBooleanStatus, fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
NOT(fmi2GetStringStatus, fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
