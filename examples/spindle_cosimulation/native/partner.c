/* FMI 2.0 for co-simulation around a model of Real variables (partner.h).
 *
 * A call that is not allowed returns fmi2Error, a value or a step that is refused fmi2Discard. Both say why
 * in the log, where the host asked for it, and change nothing. */
#include "partner.h"

#include "fmi2Functions.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INSTANTIATED = 1, INITIALISING = 2, STEPPING = 4, TERMINATED = 8 }; /* phases of a life */

static const Variable VARIABLES[N_VARIABLES] = {PARTNER_VARIABLES};
static const char GUID[] = PARTNER_GUID;
static const char *const CATEGORIES[] = {
    "logAll", "logStatusWarning", "logStatusDiscard", "logStatusError", "logStatusFatal"}; /* by status */
enum { N_CATEGORIES = sizeof CATEGORIES / sizeof CATEGORIES[0], ALL = (1 << N_CATEGORIES) - 1 };

/* All that a later call depends on; copied as it is. */
typedef struct State {
    double v[N_VARIABLES], hidden[N_HIDDEN];
    double time; /* s */
    int phase;
} State;

typedef struct Partner {
    State state;
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
    unsigned logged; /* one bit for each status */
    char *name;
} Partner;

/* Say something where that was asked for; every % doubled, as the text goes where a format is expected. */
static fmi2Status say(const Partner *it, fmi2Status status, const char *format, ...)
{
    char text[400], doubled[800], *to = doubled;
    const char *from;
    va_list arguments;
    if (!it->logger || !(it->logged >> status & 1U)) return status;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (from = text; *from; from++) {
        *to++ = *from;
        if (*from == '%') *to++ = '%';
    }
    *to = '\0';
    it->logger(it->environment, it->name, status, CATEGORIES[status], doubled);
    return status;
}

/* Whether a call comes in one of the phases; says so if not. */
static int allowed(const Partner *it, int phases, const char *call)
{
    const char *now = "is instantiated";
    if (it->state.phase & phases) return 1;
    if (it->state.phase == INITIALISING) now = "is in initialisation mode";
    if (it->state.phase == STEPPING) now = "is initialised";
    if (it->state.phase == TERMINATED) now = "is terminated";
    say(it, fmi2Error, "%s is not allowed: the instance %s", call, now);
    return 0;
}

static void begin(State *state)
{
    int i;
    memset(state, 0, sizeof *state);
    for (i = 0; i < N_VARIABLES; i++) state->v[i] = VARIABLES[i].start;
    state->phase = INSTANTIATED;
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String location,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logging)
{
    Partner *it;
    (void)location, (void)visible;
    if (!functions || !(it = calloc(1, sizeof *it))) return NULL;
    it->logger = functions->logger;
    it->environment = functions->componentEnvironment;
    it->logged = ALL; /* why there is no instance is said in any case */
    it->name = malloc(strlen(name ? name : "") + 1);
    if (it->name) strcpy(it->name, name ? name : "");
    if (!it->name) {
        say(it, fmi2Error, "no memory for an instance");
    } else if (type != fmi2CoSimulation) {
        say(it, fmi2Error, "this FMU is for co-simulation, not for model exchange");
    } else if (!guid || strcmp(guid, GUID) != 0) {
        say(it, fmi2Error, "wrong GUID: the host asks for %s, this is %s", guid ? guid : "(null)", GUID);
    } else {
        it->logged = logging ? ALL : 0;
        begin(&it->state);
        return it;
    }
    fmi2FreeInstance(it);
    return NULL;
}

void fmi2FreeInstance(fmi2Component c)
{
    Partner *it = c;
    if (it) free(it->name);
    free(it);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String names[])
{
    Partner *it = c;
    unsigned asked = count ? 0 : ALL;
    size_t i;
    int k;
    for (i = 0; i < count; i++) {
        for (k = 0; k < N_CATEGORIES && strcmp(names[i], CATEGORIES[k]) != 0; k++) continue;
        if (k == N_CATEGORIES) return say(it, fmi2Error, "there is no log category %s", names[i]);
        asked |= k == 0 ? (unsigned)ALL : 1U << k;
    }
    it->logged = on ? it->logged | asked : it->logged & ~asked;
    return fmi2OK;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop)
{
    Partner *it = c;
    (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
    if (!allowed(it, INSTANTIATED, "fmi2SetupExperiment")) return fmi2Error;
    if (!isfinite(start)) return say(it, fmi2Error, "start time %g s is not a finite number", start);
    it->state.time = start;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    Partner *it = c;
    if (!allowed(it, INSTANTIATED, "fmi2EnterInitializationMode")) return fmi2Error;
    it->state.phase = INITIALISING;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    Partner *it = c;
    if (!allowed(it, INITIALISING, "fmi2ExitInitializationMode")) return fmi2Error;
    model_initialise(it->state.v, it->state.hidden, it->state.time);
    it->state.phase = STEPPING;
    return fmi2OK;
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    Partner *it = c;
    if (!allowed(it, STEPPING, "fmi2Terminate")) return fmi2Error;
    it->state.phase = TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    begin(&((Partner *)c)->state);
    return fmi2OK;
}

static fmi2Status strange(const Partner *it, fmi2ValueReference reference)
{
    return say(it, fmi2Error, "there is no Real with value reference %u", reference);
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[])
{
    Partner *it = c;
    size_t i;
    /* in initialisation mode outputs are those of the values set so far */
    if (it->state.phase == INITIALISING) model_initialise(it->state.v, it->state.hidden, it->state.time);
    for (i = 0; i < nvr; i++) {
        if (vr[i] >= N_VARIABLES) return strange(it, vr[i]);
        value[i] = it->state.v[vr[i]];
    }
    return fmi2OK;
}

/* Take one value, or say why not. */
static fmi2Status take(Partner *it, fmi2ValueReference reference, double value)
{
    const Variable *variable;
    if (reference >= N_VARIABLES) return strange(it, reference);
    variable = &VARIABLES[reference];
    if (variable->causality == OUTPUT) return say(it, fmi2Error, "%s is computed, not set", variable->name);
    if (variable->causality == PARAMETER && it->state.phase == STEPPING && value != it->state.v[reference]) {
        return say(it, fmi2Error, "%s = %g: parameters cannot be set between steps", variable->name, value);
    }
    if (!isfinite(value)) {
        return say(it, fmi2Discard, "value not taken: %s = %g is not a finite number", variable->name, value);
    }
    it->state.v[reference] = value;
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[])
{
    Partner *it = c;
    fmi2Status worst = fmi2OK;
    size_t i;
    if (!allowed(it, INSTANTIATED | INITIALISING | STEPPING, "fmi2SetReal")) return fmi2Error;
    for (i = 0; i < nvr; i++) {
        fmi2Status status = take(it, vr[i], value[i]);
        if (status > worst) worst = status;
    }
    return worst;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real size, fmi2Boolean no_set_state)
{
    Partner *it = c;
    State *state = &it->state;
    const char *why;
    (void)no_set_state;
    if (!allowed(it, STEPPING, "fmi2DoStep")) return fmi2Error;
    /* masters count time in different ways: allow what adding up steps may lose */
    if (!(fabs(time - state->time) <= 1e-9 + 1e-12 * fabs(state->time))) {
        return say(it, fmi2Error, "a step from t = %.9g s, but the FMU is at %.9g s", time, state->time);
    }
    if (!(size > 0.0 && isfinite(size))) {
        return say(it, fmi2Discard, "a step of %g s: its size is not a positive number", size);
    }
    why = model_step(state->v, state->hidden, time, size);
    if (why) return say(it, fmi2Discard, "step of %g s from t = %.9g s refused: %s", size, time, why);
    state->time = time + size;
    return fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *kept)
{
    if (!*kept && !(*kept = malloc(sizeof(State)))) return say(c, fmi2Error, "no memory for a state");
    memcpy(*kept, &((Partner *)c)->state, sizeof(State));
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate kept)
{
    if (!kept) return say(c, fmi2Error, "there is no state to go back to");
    memcpy(&((Partner *)c)->state, kept, sizeof(State));
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *kept)
{
    (void)c;
    free(*kept);
    *kept = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate kept, size_t *size)
{
    (void)c, (void)kept;
    *size = sizeof GUID + sizeof(State);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate kept, fmi2Byte bytes[], size_t size)
{
    if (!kept || size < sizeof GUID + sizeof(State)) return say(c, fmi2Error, "no state, or no room for it");
    memcpy(bytes, GUID, sizeof GUID);
    memcpy(bytes + sizeof GUID, kept, sizeof(State));
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *kept)
{
    if (size != sizeof GUID + sizeof(State) || memcmp(bytes, GUID, sizeof GUID) != 0) {
        return say(c, fmi2Error, "these %lu bytes are not a state of this FMU", (unsigned long)size);
    }
    if (!*kept && !(*kept = malloc(sizeof(State)))) return say(c, fmi2Error, "no memory for a state");
    memcpy(*kept, bytes + sizeof GUID, sizeof(State));
    return fmi2OK;
}

/* What an FMU of Reals that steps at once does not have. */

static fmi2Status lacks(fmi2Component c, size_t count, const char *what)
{
    return count ? say(c, fmi2Error, "this FMU has no %s", what) : fmi2OK;
}

#define UNUSED (void)vr, (void)value

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[])
{
    UNUSED;
    return lacks(c, nvr, "Integers");
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[])
{
    UNUSED;
    return lacks(c, nvr, "Booleans");
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[])
{
    UNUSED;
    return lacks(c, nvr, "Strings");
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Integer value[])
{
    UNUSED;
    return lacks(c, nvr, "Integers");
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Boolean value[])
{
    UNUSED;
    return lacks(c, nvr, "Booleans");
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[])
{
    UNUSED;
    return lacks(c, nvr, "Strings");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    UNUSED, (void)order;
    return lacks(c, nvr, "input derivatives");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[])
{
    UNUSED, (void)order;
    return lacks(c, nvr, "output derivatives");
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vr[], size_t n_unknowns,
                                        const fmi2ValueReference knowns[], size_t n_knowns,
                                        const fmi2Real known[], fmi2Real value[])
{
    UNUSED, (void)knowns, (void)n_knowns, (void)known;
    return lacks(c, n_unknowns, "directional derivatives");
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return lacks(c, 1, "step to cancel, as fmi2DoStep returns when its step has ended");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)kind, (void)value;
    return say(c, fmi2Discard, "no step is pending");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    if (kind != fmi2LastSuccessfulTime) return say(c, fmi2Discard, "there is no Real status of that kind");
    *value = ((Partner *)c)->state.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind, (void)value;
    return say(c, fmi2Discard, "there is no Integer status");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    if (kind != fmi2Terminated) return say(c, fmi2Discard, "there is no Boolean status of that kind");
    *value = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)kind, (void)value;
    return say(c, fmi2Discard, "no step is pending");
}
