#include "state.h"

#include <math.h>
#include <string.h>

static const char MAGIC[16] = "fmu-bearing s 3";

enum { ALL_PHASES = PHASE_INSTANTIATED | PHASE_INITIALISING | PHASE_STEPPING | PHASE_TERMINATED | PHASE_FAILED };
enum { SHOWN = 8 }; /* bytes of a hash that a message gives */

/* Bytes of a state of this instance. */
size_t state_size(const Instance *it)
{
    const ModelHead *head = it->model.head;
    return sizeof(State) + 2 * it->bytes_z + it->bytes_s +
           (size_t)(3 * head->n_u + head->n_tunables) * sizeof(double);
}

/* Copy into the block, and move on. */
static void put(char **at, const double *numbers, uint64_t count)
{
    size_t bytes = (size_t)count * sizeof(double);
    memcpy(*at, numbers, bytes);
    *at += bytes;
}

/* Copy out of the block, and move on. */
static void get(const char **at, double *numbers, uint64_t count)
{
    size_t bytes = (size_t)count * sizeof(double);
    memcpy(numbers, *at, bytes);
    *at += bytes;
}

/* Write the present state into a block. */
void state_take(Instance *it, State *state)
{
    const ModelHead *head = it->model.head;
    char *at = (char *)(state + 1);
    instance_track(it);
    memcpy(state->magic, MAGIC, sizeof MAGIC);
    memcpy(state->kernels, head->kernels, DIGEST_SIZE);
    memcpy(state->fingerprint, head->fingerprint, DIGEST_SIZE);
    memset(state->checksum, 0, DIGEST_SIZE);
    state->size = state_size(it);
    state->phase = it->phase;
    state->settled = it->settled != 0;
    state->rated = it->rated != 0;
    state->time = it->time;
    state->reached = it->reached;
    state->last_step = it->last_step;
    put(&at, it->rates, head->n_u);
    put(&at, it->waiting, head->n_u);
    put(&at, it->u, head->n_u);
    put(&at, it->p, head->n_tunables);
    put(&at, it->z, head->n_z);
    put(&at, it->before_z, head->n_z);
    if (it->settled) {
        it->kernels->copy(it->p, it->s, (double *)at, it->sizes);
    } else {
        put(&at, it->s, head->n_s);
    }
}

/* Go back to a state. */
void state_put_back(Instance *it, const State *state)
{
    const ModelHead *head = it->model.head;
    const char *at = (const char *)(state + 1);
    uint64_t i;
    it->phase = (unsigned)state->phase;
    it->settled = state->settled != 0;
    it->rated = state->rated != 0;
    it->tracks = 1;
    it->time = state->time;
    it->reached = state->reached;
    it->last_step = state->last_step;
    it->refused = 0.0;
    get(&at, it->rates, head->n_u);
    get(&at, it->waiting, head->n_u);
    get(&at, it->u, head->n_u);
    get(&at, it->model.p, head->n_tunables);
    get(&at, it->z, head->n_z);
    get(&at, it->before_z, head->n_z);
    if (it->settled) { /* what steps do not need stays as it is */
        it->kernels->copy(it->p, (const double *)at, it->s, it->sizes);
    } else {
        get(&at, it->s, head->n_s);
    }
    it->n_waiting = 0;
    for (i = 0; i < head->n_u; i++) it->n_waiting += isnan(it->waiting[i]) == 0;
    instance_forget(it);
}

/* Append the first digits of a hash. */
static void add_hash(Text *text, const unsigned char *hash)
{
    const char *digits = "0123456789abcdef";
    int i;
    for (i = 0; i < SHOWN; i++) {
        text_add_bytes(text, &digits[hash[i] >> 4], 1);
        text_add_bytes(text, &digits[hash[i] & 15], 1);
    }
}

/* Whether two hashes differ; if so, append the reason: what the state has, what this is, and the way out. */
static int differs(const unsigned char *has, const unsigned char *own, const char *reason, const char *is,
                   const char *way_out, Text *why)
{
    if (memcmp(has, own, DIGEST_SIZE) == 0) return 0;
    text_add(why, "state not taken: ", reason, NULL);
    add_hash(why, has);
    text_add(why, is, NULL);
    add_hash(why, own);
    text_add(why, way_out, NULL);
    return 1;
}

/* Whether a block is a state of this model. */
int state_belongs(const Instance *it, const State *state, Text *why)
{
    const ModelHead *head = it->model.head;
    const char *problem = NULL;
    if (memcmp(state->magic, MAGIC, sizeof MAGIC) != 0) {
        problem = "these bytes are not a state that this version of fmu-bearing can read";
    } else if (differs(state->kernels, head->kernels, "the state was made by another version of the engine, ",
                       ", and this FMU has ", ": set it in the FMU that made it, or take a new one here", why) ||
               differs(state->fingerprint, head->fingerprint, "the state belongs to another model, ",
                       ", and this is ",
                       ": its scene is another, or was prepared by another version of fmu-bearing; set it in an FMU "
                       "of that model, or take a new one here",
                       why)) {
        return 0;
    } else if (state->size != state_size(it)) {
        problem = "the state is damaged: its size is wrong";
    }
    if (problem) text_add(why, "state not taken: ", problem, NULL);
    return !problem;
}

/* Begin of what the checksum covers. */
static const char *covered(const State *state)
{
    return (const char *)&state->size;
}

/* Write the checksum into a block. */
void state_seal(State *state)
{
    size_t before = (size_t)(covered(state) - (const char *)state);
    digest(covered(state), (size_t)state->size - before, state->checksum);
}

/* Whether a number is one of the phases. */
static int is_phase(uint64_t phase)
{
    return (phase & ALL_PHASES) == phase && phase != 0 && (phase & (phase - 1)) == 0;
}

/* Whether bytes just read are a state of this model. */
int state_is_whole(const Instance *it, const State *state, size_t size, Text *why)
{
    const char *problem = NULL;
    if (size >= sizeof *state && !state_belongs(it, state, why)) return 0;
    if (size < state_size(it)) {
        problem = "the state is cut off";
    } else if (size > state_size(it)) {
        problem = "the state is damaged: it has more bytes than this model's";
    } else if (!digest_holds(covered(state), (size_t)state->size - (size_t)(covered(state) - (const char *)state),
                             state->checksum)) {
        problem = "the state is damaged: its checksum does not hold";
    } else if (!is_phase(state->phase)) {
        problem = "the state is damaged: it has no phase";
    }
    if (problem) text_add(why, "state not taken: ", problem, NULL);
    return !problem;
}
