/* FMI 2.0: communication steps. */
#include "calls.h"
#include "float_mode.h"

#include "fmi2Functions.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Append which step is refused. */
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

/* Refuse a step that the time cannot hold: so far from 0 the next double is further away than the step ends. */
static fmi2Status coarse_time(Instance *it, double time, double size)
{
    Text text = {0};
    add_step(&text, time, size);
    text_add(&text, "from ", NULL);
    text_add_number(&text, it->time, 0);
    text_add(&text, " s on a double holds no such step, and time would not move by it: begin the experiment at a "
             "start time nearer to 0 s, or take longer steps", NULL);
    return instance_fail(it, &text);
}

/* Refuse a step. Refused again, with nothing changed, it is an error: there are masters that repeat a
 * discarded step for ever. `same` is the size at which it would be refused again. */
static fmi2Status discard(Instance *it, double same, Text *text)
{
    if (same == it->refused) {
        text_add(text, "; again, and nothing was changed", NULL);
        return instance_fail(it, text);
    }
    it->refused = same;
    return instance_refuse(it, fmi2Discard, text);
}

/* Refuse a step while an input has had no value in its range. */
static fmi2Status still_waiting(Instance *it, double time, double size)
{
    Text text = {0};
    uint64_t i;
    add_step(&text, time, size);
    for (i = 0; i < it->n_variables; i++) {
        const ModelVariable *variable = &it->model.variables[i];
        double value = variable->array == ARRAY_U ? it->waiting[variable->index] : NAN;
        if (isnan(value)) continue;
        instance_may_have(it, i, value, &text);
        text_add(&text, "; ", NULL);
    }
    text_add(&text, "set before the end of initialisation, and no value in the range has come since", NULL);
    it->reached = it->time;
    return discard(it, INFINITY, &text);
}

/* Copy numbers; a few of them in line, as a call would take longer. */
static inline void copy(double *to, const double *from, size_t count)
{
    size_t i;
    if (count > 16) {
        memcpy(to, from, count * sizeof(double));
        return;
    }
    for (i = 0; i < count; i++) to[i] = from[i];
}

/* Note a step. A copy of a large state takes longer than many a step, so one serves several: as the engine
 * answers the same to the last bit, repeating the steps since leads to any state on the way. */
static inline void note(Instance *it, double size, const double *inputs)
{
    double *entry;
    if (it->most_journal == 1) { /* a small state */
        copy(it->kept_s, it->s, (size_t)it->sizes[2]);
        it->n_journal = 1;
        return;
    }
    if (it->n_journal == it->most_journal || it->span + size > it->most_span) {
        it->kernels->copy(it->p, it->s, it->kept_s, it->sizes);
        it->n_journal = 0;
        it->span = 0.0;
    }
    entry = it->journal + it->n_journal * it->entry_size;
    memcpy(entry + 1, inputs, (it->entry_size - 1) * sizeof(double));
    entry[0] = size;
    it->span += size;
    it->n_journal++;
}

/* Go back to the state before the step noted last; 0 if the engine does not do again what it did. */
static int go_back(Instance *it)
{
    uint64_t i;
    if (it->most_journal == 1) {
        memcpy(it->s, it->kept_s, it->bytes_s);
    } else {
        it->kernels->copy(it->p, it->kept_s, it->s, it->sizes);
    }
    for (i = 0; i + 1 < it->n_journal; i++) {
        const double *entry = it->journal + i * it->entry_size;
        if (it->step(it->p, entry + 1, it->s, it->z, it->w, it->sizes, entry[0]) != 0) return 0;
    }
    instance_forget(it);
    return 1;
}

/* Go back to where the step began, and say why it did not succeed. */
static fmi2Status undo(Instance *it, double time, double size, int32_t status)
{
    Text text = {0};
    int there;
    it->reached = *it->engine_time;
    there = go_back(it);
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
    if (there) return discard(it, size, &text);
    text_add(&text, "; the state before the step could not be found again", NULL);
    return instance_fail(it, &text);
}

/* Let the engine step with these inputs; where that fails everything is as before. */
static inline fmi2Status advance(Instance *it, double time, double size, const double *inputs)
{
    int32_t status;
    note(it, size, inputs);
    if (it->tracks) memcpy(it->kept_z, it->z, it->bytes_z);
    status = it->step(it->p, inputs, it->s, it->z, it->w, it->sizes, size);
    if (status != 0) return undo(it, time, size, status);
    if (it->tracks) {
        double *spare = it->before_z;
        it->before_z = it->kept_z;
        it->kept_z = spare;
    }
    it->last_step = size;
    it->refused = 0.0;
    it->reached = it->time = time + size;
    instance_warn(it);
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

/* Step with rates: inputs that the engine ramps or leads are at their end values, others in their middle. */
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
        return discard(it, size, &text);
    }
    for (i = 0; i < head->n_u; i++) {
        double share = i == head->ramped || i - head->led < head->n_led ? 1.0 : 0.5;
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
    FloatMode host;
    fmi2Status status;
    (void)no_set_state;
    if (!call_allowed(it, CALL_DO_STEP)) return call_refused(it, CALL_DO_STEP);
    if (!(size > 0.0 && size <= DBL_MAX)) return no_step(it, time, size);
    /* masters count time in different ways: allow what adding up steps may lose */
    if (!(fabs(time - it->time) <= 1e-9 + 1e-12 * fabs(it->time))) return wrong_time(it, time, size);
    if (!(fabs(it->time + size - it->time - size) <= 0.5 * size)) return coarse_time(it, time, size);
    if (it->n_waiting) return still_waiting(it, time, size);
    host = float_mode_take();
    status = it->rated ? ramped(it, time, size) : advance(it, time, size, it->u);
    float_mode_give_back(host);
    return status;
}
