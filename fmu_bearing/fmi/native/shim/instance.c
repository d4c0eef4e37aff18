#include "instance.h"

#include "float_mode.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CACHE_LINE = 8 }; /* doubles */

/* A value at a bound may carry rounding from a unit conversion. */
static const double RELATIVE_SLACK = 1e-12;

/* Say why a call is refused, and return its status. */
fmi2Status instance_refuse(Instance *it, fmi2Status status, Text *text)
{
    log_say(&it->log, status, text);
    text_free(text);
    return status;
}

/* Say why a call is an error. */
fmi2Status instance_fail(Instance *it, Text *text)
{
    it->phase = PHASE_FAILED;
    return instance_refuse(it, fmi2Error, text);
}

/* Note a change. A value that waits is no other for it: only its own true value helps. */
void instance_changed(Instance *it)
{
    if (!it->n_waiting) it->refused = 0.0;
}

/* Next array in the one block of memory, on a cache line of its own; only counted while there is none. */
static double *carve(double *memory, size_t *used, uint64_t count)
{
    double *found = memory ? memory + *used : NULL;
    *used += ((size_t)count + CACHE_LINE - 1) / CACHE_LINE * CACHE_LINE;
    return found;
}

/* Hand out the arrays of an instance from its memory; returns how many numbers they need. */
static size_t carve_arrays(Instance *it, double *memory)
{
    const ModelHead *head = it->model.head;
    size_t used = 0;
    it->u = carve(memory, &used, head->n_u);
    it->rates = carve(memory, &used, head->n_u);
    it->held = carve(memory, &used, head->n_u);
    it->waiting = carve(memory, &used, head->n_u);
    it->tunables = carve(memory, &used, head->n_tunables);
    it->z = carve(memory, &used, head->n_z);
    it->kept_z = carve(memory, &used, head->n_z);
    it->before_z = carve(memory, &used, head->n_z);
    it->s = carve(memory, &used, head->n_s);
    it->kept_s = carve(memory, &used, head->n_s);
    it->w = carve(memory, &used, head->n_w);
    it->journal = carve(memory, &used, head->journal * (head->n_u + 1));
    return used + CACHE_LINE;
}

/* Find for every value reference where its value is. */
static void fill_slots(Instance *it)
{
    double *arrays[4];
    uint64_t i;
    arrays[ARRAY_NONE] = NULL;
    arrays[ARRAY_U] = it->u;
    arrays[ARRAY_Z] = it->z;
    arrays[ARRAY_P] = it->model.p;
    for (i = 0; i < it->n_variables; i++) {
        const ModelVariable *variable = &it->model.variables[i];
        Slot *slot = &it->slots[i];
        int tunable = variable->causality == CAUSALITY_INPUT || variable->causality == CAUSALITY_PARAMETER;
        slot->type = (unsigned char)variable->type;
        slot->causality = (unsigned char)variable->causality;
        slot->computed = variable->array == ARRAY_Z;
        slot->settable = tunable && variable->variability != VARIABILITY_CONSTANT &&
                         (variable->array == ARRAY_U || variable->array == ARRAY_P);
        slot->fixed = variable->causality == CAUSALITY_PARAMETER && variable->variability != VARIABILITY_TUNABLE;
        slot->at = variable->array == ARRAY_NONE ? (double *)&it->model.variables[i].value
                                                 : arrays[variable->array] + variable->index;
    }
}

/* Take the memory of an instance whose model is set; 0 if there is not enough. */
static int allocate(Instance *it, const char *name)
{
    size_t line = CACHE_LINE * sizeof(double);
    size_t past;
    it->n_variables = it->model.head->n_variables;
    it->name = malloc(strlen(name) + 1);
    it->slots = calloc(it->n_variables ? (size_t)it->n_variables : 1, sizeof *it->slots);
    it->memory = calloc(carve_arrays(it, NULL), sizeof(double));
    if (!it->name || !it->slots || !it->memory) return 0;
    memcpy(it->name, name, strlen(name) + 1);
    past = (size_t)((uintptr_t)it->memory % line);
    carve_arrays(it, it->memory + (past ? (line - past) / sizeof(double) : 0));
    return 1;
}

/* Make an instance. */
Instance *instance_new(Model *model, const Log *log, Text *why)
{
    const Kernels *kernels = kernels_choose(model->p, why);
    Instance *it = kernels ? calloc(1, sizeof *it) : NULL;
    const ModelHead *head = model->head;
    if (!kernels) return NULL;
    if (it) it->model = *model;
    if (!it || !allocate(it, log->name)) {
        text_add(why, "there is not enough memory for the instance", NULL);
        if (it) memset(&it->model, 0, sizeof it->model);
        instance_free(it);
        return NULL;
    }
    it->kernels = kernels;
    it->step = kernels->step;
    it->log = *log;
    it->log.name = it->name;
    it->log.model = &it->model;
    it->p = it->model.p;
    it->sizes[0] = (int64_t)head->n_p;
    it->sizes[1] = (int64_t)head->n_u;
    it->sizes[2] = (int64_t)head->n_s;
    it->sizes[3] = (int64_t)head->n_z;
    it->sizes[4] = (int64_t)head->n_w;
    it->bytes_s = (size_t)head->n_s * sizeof(double);
    it->bytes_z = (size_t)head->n_z * sizeof(double);
    it->most_journal = head->journal;
    it->most_span = head->journal_span;
    it->entry_size = (size_t)head->n_u + 1;
    it->engine_time = it->s + head->time;
    memcpy(it->tunables, it->p, (size_t)head->n_tunables * sizeof(double));
    fill_slots(it);
    instance_reset(it);
    return it;
}

/* Give back all memory of an instance. */
void instance_free(Instance *it)
{
    if (!it) return;
    model_free(&it->model);
    free(it->memory);
    free(it->slots);
    free(it->name);
    free(it);
}

/* Back to what a fresh instance is. */
void instance_reset(Instance *it)
{
    const ModelHead *head = it->model.head;
    uint64_t i;
    it->phase = PHASE_INSTANTIATED;
    it->settled = 0;
    it->rated = 0;
    it->early = 0;
    it->tracks = it->most_journal > 1; /* then the state before the last step is not at hand */
    instance_forget(it);
    it->time = it->reached = it->last_step = it->refused = 0.0;
    memcpy(it->model.p, it->tunables, (size_t)head->n_tunables * sizeof(double));
    memcpy(it->u, it->model.u, (size_t)head->n_u * sizeof(double));
    memset(it->rates, 0, (size_t)head->n_u * sizeof(double));
    it->n_waiting = 0;
    for (i = 0; i < head->n_u; i++) it->waiting[i] = NAN;
    memset(it->s, 0, it->bytes_s);
    memset(it->z, 0, it->bytes_z);
    memset(it->before_z, 0, it->bytes_z);
}

/* Forget the state some steps ago: the next step then begins with a copy. */
void instance_forget(Instance *it)
{
    it->n_journal = it->most_journal;
}

/* Fill the outputs before the last step, and keep them from now on. They follow from the state alone, so
 * with a copy of it for each step those who never ask for rates of outputs pay nothing for them. */
void instance_track(Instance *it)
{
    if (it->tracks) return;
    if (it->last_step > 0.0) {
        FloatMode host = float_mode_take();
        it->kernels->outputs(it->p, it->kept_s, it->before_z, it->sizes);
        float_mode_give_back(host);
    }
    it->tracks = 1;
}

/* Keep a value out of range, and go on with the start value. */
void instance_keep_waiting(Instance *it, uint64_t reference, double value)
{
    uint32_t at = it->model.variables[reference].index;
    it->n_waiting += isnan(it->waiting[at]) != 0;
    it->waiting[at] = value;
    it->u[at] = it->model.u[at];
}

/* Note that an input has a value in its range. */
void instance_end_waiting(Instance *it, uint64_t reference)
{
    const ModelVariable *variable = &it->model.variables[reference];
    if (variable->array != ARRAY_U || isnan(it->waiting[variable->index])) return;
    it->waiting[variable->index] = NAN;
    it->n_waiting--;
    it->refused = 0.0;
}

/* Append "inputs were shaft_speed = ...". */
void instance_add_inputs(const Instance *it, Text *text)
{
    const char *between = "inputs were ";
    uint64_t i;
    for (i = 0; i < it->n_variables; i++) {
        const ModelVariable *variable = &it->model.variables[i];
        if (variable->array != ARRAY_U) continue;
        text_add(text, between, model_text(&it->model, variable->name), " = ", NULL);
        text_add_number(text, it->u[variable->index], 6);
        between = ", ";
    }
}

void instance_warn(Instance *it)
{
    uint64_t i;
    for (i = 0; i < it->model.head->n_cautions; i++) {
        const ModelCaution *caution = &it->model.cautions[i];
        double value = caution->array == ARRAY_U ? it->u[caution->index] : it->z[caution->index];
        Text text = {0};
        int due = caution->above ? value > caution->threshold : value < caution->threshold;
        if (!due || it->warned >> i & 1) continue;
        it->warned |= (uint64_t)1 << i;
        text_add(&text, model_text(&it->model, caution->before), NULL);
        text_add_fixed(&text, caution->scale * value, (int)caution->decimals);
        text_add(&text, model_text(&it->model, caution->after), NULL);
        instance_refuse(it, fmi2Warning, &text);
    }
}

/* Put the engine to its steady state at the values so far, once. */
fmi2Status instance_settle(Instance *it, fmi2Status otherwise)
{
    Text text = {0};
    FloatMode host;
    int32_t status;
    if (it->settled) return fmi2OK;
    memset(it->s, 0, it->bytes_s);
    memset(it->z, 0, it->bytes_z);
    host = float_mode_take();
    status = it->kernels->init(it->p, it->u, it->s, it->z, it->w, it->sizes, it->time);
    float_mode_give_back(host);
    if (status == 0) {
        it->settled = 1;
        it->warned = 0;
        instance_warn(it);
        return fmi2OK;
    }
    text_add(&text, "initialisation at t = ", NULL);
    text_add_number(&text, it->time, 0);
    text_add(&text, " s: ", NULL);
    model_add_reason(&it->model, status, &text);
    text_add(&text, "; ", NULL);
    instance_add_inputs(it, &text);
    return instance_refuse(it, otherwise, &text);
}

/* Whether a variable may have a value. */
int instance_may_have(const Instance *it, uint64_t reference, double value, Text *why)
{
    const ModelVariable *variable = &it->model.variables[reference];
    double low = fabs(variable->min), high = fabs(variable->max);
    double slack = RELATIVE_SLACK * fmax(low <= DBL_MAX ? low : 0.0, high <= DBL_MAX ? high : 0.0);
    const char *unit = model_text(&it->model, variable->unit);
    if (isfinite(value) && variable->min - slack <= value && value <= variable->max + slack) return 1;
    text_add(why, model_text(&it->model, variable->name), " = ", NULL);
    text_add_number(why, value, 0);
    text_add(why, " is refused: allowed are ", NULL);
    text_add_number(why, variable->min, 6);
    text_add(why, " to ", NULL);
    text_add_number(why, variable->max, 6);
    text_add(why, *unit ? " " : NULL, unit, NULL);
    return 0;
}
