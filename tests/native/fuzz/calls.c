#include "fuzz.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST = 12 };

/* Arguments of a call about several values, in memory of just that length. */
typedef struct Values {
    size_t count;
    fmi2ValueReference *references;
    fmi2Integer *orders, *wholes;
    fmi2Real *reals;
    fmi2String *strings;
} Values;

/* Memory for so many items, now and then none at all. */
static void *room(Fuzz *fuzz, size_t count, size_t size)
{
    return chance(fuzz, 2) ? NULL : malloc(count ? count * size : 1);
}

/* A value reference that may be there. */
static fmi2ValueReference any_reference(Fuzz *fuzz)
{
    if (chance(fuzz, 40)) return (fmi2ValueReference)below(fuzz, FIRST); /* the inputs come first */
    if (chance(fuzz, 90)) return (fmi2ValueReference)below(fuzz, fuzz->n_variables);
    return (fmi2ValueReference)(chance(fuzz, 50) ? fuzz->n_variables + below(fuzz, 3) : below(fuzz, UINT64_MAX));
}

/* Random arguments. */
static Values any_values(Fuzz *fuzz)
{
    static const fmi2Integer WHOLES[] = {0, 1, 2, 3, -1, 7, INT32_MAX, INT32_MIN};
    static const fmi2String STRINGS[] = {"", "text", "%s%n", NULL};
    Values values;
    size_t i;
    values.count = (size_t)below(fuzz, MOST_VALUES);
    values.references = room(fuzz, values.count, sizeof *values.references);
    values.orders = room(fuzz, values.count, sizeof *values.orders);
    values.wholes = room(fuzz, values.count, sizeof *values.wholes);
    values.reals = room(fuzz, values.count, sizeof *values.reals);
    values.strings = room(fuzz, values.count, sizeof *values.strings);
    for (i = 0; i < values.count; i++) {
        if (values.references) values.references[i] = any_reference(fuzz);
        if (values.orders) values.orders[i] = chance(fuzz, 90) ? 1 : WHOLES[below(fuzz, 8)];
        if (values.wholes) values.wholes[i] = WHOLES[below(fuzz, 8)];
        if (values.reals) values.reals[i] = any_real(fuzz);
        if (values.strings) values.strings[i] = STRINGS[below(fuzz, 4)];
    }
    return values;
}

/* Give the arguments back. */
static void free_values(Values *values)
{
    free(values->references);
    free(values->orders);
    free(values->wholes);
    free(values->reals);
    free((void *)values->strings);
}

/* No value that was read may be NaN or infinite; the kernels made for this program do give such. */
static void check_finite(const Fuzz *fuzz, const fmi2Real *values, size_t count)
{
    size_t i;
    for (i = 0; i < count && !fuzz->forge; i++) {
        if (!isfinite(values[i])) give_up(fuzz, "getReal", "gave a value that is not finite");
    }
}

/* Read or set values, mostly one of a time: one wrong reference refuses the others too. */
static void values_of(Fuzz *fuzz, Slave *slave)
{
    fmi2Component c = slave->instance;
    Values v = any_values(fuzz);
    size_t n = v.count > 1 && chance(fuzz, 60) ? 1 : v.count, i;
    switch (below(fuzz, 10)) {
    case 0: answer(fuzz, "getInteger", fmi2GetInteger(c, v.references, n, v.wholes)); break;
    case 1: answer(fuzz, "getBoolean", fmi2GetBoolean(c, v.references, n, v.wholes)); break;
    case 2:
        if (answer(fuzz, "getString", fmi2GetString(c, v.references, n, v.strings)) != fmi2OK) break;
        for (i = 0; i < n; i++) fuzz->logged += strlen(v.strings[i]) > 1000000; /* reads it to its end */
        break;
    case 3: answer(fuzz, "setInteger", fmi2SetInteger(c, v.references, n, v.wholes)); break;
    case 4: answer(fuzz, "setBoolean", fmi2SetBoolean(c, v.references, n, v.wholes)); break;
    case 5: answer(fuzz, "setString", fmi2SetString(c, v.references, n, v.strings)); break;
    case 6:
        if (answer(fuzz, "getReal", fmi2GetReal(c, v.references, n, v.reals)) != fmi2OK) break;
        check_finite(fuzz, v.reals, n);
        break;
    case 7:
        answer(fuzz, "setRealInputDerivatives",
               fmi2SetRealInputDerivatives(c, v.references, n, v.orders, v.reals));
        break;
    case 8:
        answer(fuzz, "getRealOutputDerivatives",
               fmi2GetRealOutputDerivatives(c, v.references, n, v.orders, v.reals));
        break;
    default: answer(fuzz, "setReal", fmi2SetReal(c, v.references, n, v.reals));
    }
    free_values(&v);
}

/* Take a step, mostly a usual one from where the instance stands. */
static void step(Fuzz *fuzz, Slave *slave)
{
    double time = chance(fuzz, 97) ? slave->time : any_real(fuzz);
    double size = chance(fuzz, 94) ? fuzz->usual_step : any_real(fuzz);
    fmi2Status status;
    if (size > 10.0 * fuzz->usual_step && size < 1e6) size = fuzz->usual_step; /* long work, but no hang */
    status = answer(fuzz, "doStep", fmi2DoStep(slave->instance, time, size, chance(fuzz, 50)));
    if (status == fmi2OK) {
        slave->time = time + size;
        fuzz->steps++;
    }
    fuzz->discarded_steps += status == fmi2Discard;
}

/* Ask how the last step went. */
static void status_of(Fuzz *fuzz, Slave *slave)
{
    fmi2StatusKind kind = (fmi2StatusKind)(chance(fuzz, 95) ? below(fuzz, 4) : below(fuzz, 1000));
    int none = chance(fuzz, 3);
    fmi2Status status = fmi2OK;
    fmi2Real real = 0.0;
    fmi2Integer whole = 0;
    fmi2String text = NULL;
    fmi2Component c = slave->instance;
    switch (below(fuzz, 5)) {
    case 0: answer(fuzz, "getStatus", fmi2GetStatus(c, kind, none ? NULL : &status)); break;
    case 1: answer(fuzz, "getIntegerStatus", fmi2GetIntegerStatus(c, kind, none ? NULL : &whole)); break;
    case 2: answer(fuzz, "getBooleanStatus", fmi2GetBooleanStatus(c, kind, none ? NULL : &whole)); break;
    case 3: answer(fuzz, "getStringStatus", fmi2GetStringStatus(c, kind, none ? NULL : &text)); break;
    default: answer(fuzz, "getRealStatus", fmi2GetRealStatus(c, kind, none ? NULL : &real));
    }
}

/* Keep, put back or free a state. */
static void state_of(Fuzz *fuzz, Slave *slave)
{
    fmi2FMUstate *state = &slave->states[below(fuzz, MOST_STATES)];
    fmi2Component c = slave->instance;
    double time = slave->time;
    if (chance(fuzz, 3)) {
        answer(fuzz, "getFMUstate", fmi2GetFMUstate(c, NULL));
        answer(fuzz, "setFMUstate", fmi2SetFMUstate(c, NULL));
        answer(fuzz, "freeFMUstate", fmi2FreeFMUstate(c, NULL));
    } else if (chance(fuzz, 40)) {
        answer(fuzz, "getFMUstate", fmi2GetFMUstate(c, state));
    } else if (chance(fuzz, 80)) {
        fmi2Status status = answer(fuzz, "setFMUstate", fmi2SetFMUstate(c, *state));
        /* the host is asked for the time it had then; it learns it from the last successful one */
        if (status == fmi2OK && fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &time) == fmi2OK) slave->time = time;
    } else {
        answer(fuzz, "freeFMUstate", fmi2FreeFMUstate(c, state));
    }
}

/* A call that leads from one phase to another. */
static void move_on(Fuzz *fuzz, Slave *slave)
{
    fmi2Component c = slave->instance;
    double start = chance(fuzz, 90) ? 0.0 : any_real(fuzz);
    double tolerance = any_real(fuzz), stop = any_real(fuzz);
    fmi2Boolean has_tolerance = chance(fuzz, 20), has_stop = chance(fuzz, 50);
    switch (below(fuzz, 12)) {
    case 0: answer(fuzz, "terminate", fmi2Terminate(c)); break;
    case 1:
    case 2: answer(fuzz, "reset", fmi2Reset(c)); break;
    case 3: answer(fuzz, "cancelStep", fmi2CancelStep(c)); break;
    case 4:
    case 5:
    case 6: answer(fuzz, "enterInitializationMode", fmi2EnterInitializationMode(c)); break;
    case 7:
    case 8:
    case 9: answer(fuzz, "exitInitializationMode", fmi2ExitInitializationMode(c)); break;
    default:
        if (answer(fuzz, "setupExperiment",
                   fmi2SetupExperiment(c, has_tolerance, tolerance, start, has_stop, stop)) != fmi2Error) {
            slave->time = start;
        }
    }
}

/* Choose what is logged, with names that are missing or unknown at times. */
static void choose_log(Fuzz *fuzz, Slave *slave)
{
    static const fmi2String NAMES[] = {"logAll", "logStatusError", "logStatusDiscard", "logStatusWarning",
                                       "nothing", NULL};
    fmi2String names[3];
    size_t i, count = (size_t)below(fuzz, 4);
    fmi2Boolean on;
    for (i = 0; i < 3; i++) names[i] = NAMES[below(fuzz, chance(fuzz, 80) ? 4 : 6)];
    on = chance(fuzz, 80);
    answer(fuzz, "setDebugLogging",
           fmi2SetDebugLogging(slave->instance, on, count, chance(fuzz, 10) ? NULL : names));
}

/* Bring an instance to where it can step, whatever it was. */
static void begin(Fuzz *fuzz, Slave *slave)
{
    fmi2Component c = slave->instance;
    if (answer(fuzz, "reset", fmi2Reset(c)) != fmi2OK) give_up(fuzz, "reset", "was refused");
    slave->time = chance(fuzz, 95) ? 0.0 : 1e9;
    answer(fuzz, "setupExperiment", fmi2SetupExperiment(c, fmi2False, 0.0, slave->time, fmi2False, 0.0));
    answer(fuzz, "enterInitializationMode", fmi2EnterInitializationMode(c));
    answer(fuzz, "exitInitializationMode", fmi2ExitInitializationMode(c));
}

/* Partial derivatives, which models with led inputs have. */
static void partial(Fuzz *fuzz, Slave *slave)
{
    Values v = any_values(fuzz), by = any_values(fuzz);
    size_t n = v.count > 1 && chance(fuzz, 60) ? 1 : v.count, m = by.count > 1 && chance(fuzz, 60) ? 1 : by.count;
    const fmi2Real *known = chance(fuzz, 95) ? by.reals : NULL;
    if (answer(fuzz, "getDirectionalDerivative",
               fmi2GetDirectionalDerivative(slave->instance, v.references, n, by.references, m, known,
                                            v.reals)) == fmi2OK) {
        check_finite(fuzz, v.reals, n);
    }
    free_values(&v);
    free_values(&by);
}

/* Calls on no instance. */
static void call_nobody(Fuzz *fuzz, Slave *slave)
{
    Slave nobody = {0};
    long allowed = fuzz->answers[fmi2OK];
    (void)slave;
    values_of(fuzz, &nobody);
    step(fuzz, &nobody);
    state_of(fuzz, &nobody);
    damage_state(fuzz, &nobody);
    status_of(fuzz, &nobody);
    choose_log(fuzz, &nobody);
    move_on(fuzz, &nobody);
    partial(fuzz, &nobody);
    if (fuzz->answers[fmi2OK] > allowed) give_up(fuzz, "a call", "succeeded on no instance");
}

/* One random call, and often a new beginning where it was an error. */
void call_something(Fuzz *fuzz, Slave *slave)
{
    static const struct {
        uint64_t share;
        void (*call)(Fuzz *, Slave *);
    } CALLS[] = {{40, values_of}, {30, step}, {9, state_of}, {5, damage_state}, {4, status_of},
                 {3, choose_log}, {5, move_on}, {2, begin}, {1, partial}, {1, call_nobody}};
    uint64_t which = below(fuzz, 100);
    long errors = fuzz->answers[fmi2Error];
    size_t i = 0;
    while (which >= CALLS[i].share) which -= CALLS[i++].share;
    CALLS[i].call(fuzz, slave);
    if (fuzz->answers[fmi2Error] > errors && chance(fuzz, 50)) begin(fuzz, slave);
}
