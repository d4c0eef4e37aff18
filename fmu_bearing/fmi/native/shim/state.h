/* The state of an instance as one flat block without pointers: kept aside, put back, sent as bytes. */
#ifndef FB_STATE_H
#define FB_STATE_H

#include "instance.h"

typedef struct State {
    unsigned char magic[16];
    unsigned char kernels[DIGEST_SIZE];     /* that made it: the reason where the fingerprint differs */
    unsigned char fingerprint[DIGEST_SIZE]; /* of the model it belongs to */
    unsigned char checksum[DIGEST_SIZE];    /* of all that follows; set in bytes only */
    uint64_t size;                          /* of the block in bytes */
    uint64_t phase, settled, rated;
    double time, reached, last_step;
    /* then rates, waiting values of inputs, inputs, head of the parameters, outputs, outputs before the last step, engine */
} State;

/* Bytes of a state of this instance. */
size_t state_size(const Instance *it);

/* Write the present state into a block of that size, all zero: what steps do not need stays so. */
void state_take(Instance *it, State *state);

/* Go back to a state, which must be one of this model. */
void state_put_back(Instance *it, const State *state);

/* Whether a block is a state of this model; appends why not. */
int state_belongs(const Instance *it, const State *state, Text *why);

/* Write the checksum into a block. */
void state_seal(State *state);

/* Whether bytes just read are a state of this model, whole and undamaged; appends why not. */
int state_is_whole(const Instance *it, const State *state, size_t size, Text *why);

#endif
