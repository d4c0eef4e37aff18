#include "fuzz.h"
#include "model.h"
#include "state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LARGE = 1 << 14, LARGEST = 1 << 24 };
enum {
    MODEL_CHECKSUM = offsetof(ModelHead, checksum),
    MODEL_SIZES = offsetof(ModelHead, n_p),
    MODEL_HEAD = sizeof(ModelHead),
    VARIABLE = sizeof(ModelVariable),
    STATE_CHECKSUM = offsetof(State, checksum),
    STATE_HEAD = sizeof(State)
};

/* Another value for a count, near the right one or far away. */
static uint64_t any_count(Fuzz *fuzz, uint64_t right)
{
    uint64_t off = below(fuzz, 2);
    switch (below(fuzz, 4)) {
    case 0: return right + below(fuzz, 7) - 3;
    case 1: return below(fuzz, 40);
    case 2: return (UINT64_C(1) << below(fuzz, 64)) - off;
    default: return UINT64_MAX - below(fuzz, 4);
    }
}

/* Put another count where a head has one. */
static void change_count(Fuzz *fuzz, unsigned char *at)
{
    uint64_t count;
    memcpy(&count, at, sizeof count);
    count = any_count(fuzz, count);
    memcpy(at, &count, sizeof count);
}

/* Change some bits, bytes or counts of a block; 1 if it then differs from what it was. */
static int damage(Fuzz *fuzz, unsigned char *bytes, size_t size, size_t head, size_t head_end)
{
    unsigned char *before = malloc(size ? size : 1);
    size_t i, count = 1 + (size_t)below(fuzz, 4);
    int differs;
    memcpy(before, bytes, size);
    for (i = 0; i < count && size; i++) {
        size_t at = (size_t)below(fuzz, size);
        if (head_end <= size && chance(fuzz, 40)) {
            change_count(fuzz, bytes + head + 8 * below(fuzz, (head_end - head) / 8));
        } else if (chance(fuzz, 50)) {
            bytes[at] ^= (unsigned char)(1U << below(fuzz, 8));
        } else {
            bytes[at] = (unsigned char)below(fuzz, 256);
        }
    }
    differs = memcmp(before, bytes, size) != 0;
    free(before);
    return differs;
}

/* Arrays that are large and yet possible only take time: make them small again. */
static void shrink(unsigned char *file)
{
    unsigned char *at = file + MODEL_SIZES + 2 * 8; /* behind the numbers of parameters and inputs */
    uint64_t count;
    int i;
    for (i = 0; i < 3; i++, at += 8) {
        memcpy(&count, at, sizeof count);
        if (count > LARGE && count <= 4 * LARGEST) count %= LARGE;
        memcpy(at, &count, sizeof count);
    }
}

/* Change some numbers of one variable, among the first ones rather than the others. */
static void change_variable(Fuzz *fuzz, unsigned char *file)
{
    uint64_t before[2], variable = below(fuzz, chance(fuzz, 70) ? 4 : fuzz->n_variables);
    unsigned char *at;
    int i;
    memcpy(before, file + MODEL_SIZES, sizeof before); /* of parameters and inputs */
    at = file + MODEL_HEAD + 8 * (before[0] + before[1]) + VARIABLE * variable;
    for (i = 0; i < 2; i++) {
        uint64_t place = below(fuzz, 5); /* type, causality, variability, array, index */
        uint32_t number = (uint32_t)below(fuzz, place == 4 && chance(fuzz, 50) ? UINT32_MAX : 4);
        memcpy(at + 4 * place, &number, sizeof number);
    }
}

/* Write a damaged file; 1 if it must be refused, as its checksum was left as it is. */
static int write_bad(Fuzz *fuzz)
{
    size_t size = chance(fuzz, 80) ? fuzz->model_size : (size_t)below(fuzz, fuzz->model_size);
    unsigned char *bytes = malloc(fuzz->model_size);
    int differs, forged = fuzz->forge && chance(fuzz, 85);
    FILE *file = fopen(fuzz->bad_file, "wb");
    memcpy(bytes, fuzz->model, fuzz->model_size);
    if (forged && size == fuzz->model_size && chance(fuzz, 40)) {
        change_variable(fuzz, bytes);
        differs = 1;
    } else {
        differs = damage(fuzz, bytes, size, MODEL_SIZES, MODEL_HEAD) || size < fuzz->model_size;
    }
    if (forged && size >= MODEL_HEAD) shrink(bytes);
    if (forged && size > MODEL_CHECKSUM + 32) {
        digest(bytes + MODEL_CHECKSUM + 32, size - MODEL_CHECKSUM - 32, bytes + MODEL_CHECKSUM);
    }
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file) != 0) {
        give_up(fuzz, fuzz->bad_file, "cannot be written");
    }
    free(bytes);
    return differs && !forged;
}

/* Make instances on a damaged file, and call some of their functions. */
void damage_model(Fuzz *fuzz)
{
    int to_refuse = write_bad(fuzz), i;
    Slave slave = {0};
    slave.instance = make(fuzz, fuzz->bad, 0);
    if (!slave.instance) {
        fuzz->refused_models++;
        return;
    }
    if (to_refuse) give_up(fuzz, "instantiate", "took a damaged model");
    fuzz->forged_models++;
    for (i = 0; i < 60; i++) call_something(fuzz, &slave);
    drop(fuzz, &slave);
}

/* The bytes of the state of an instance, NULL if it did not give them. */
static unsigned char *bytes_of(Fuzz *fuzz, fmi2Component c, size_t *size)
{
    fmi2FMUstate state = NULL;
    unsigned char *bytes;
    if (answer(fuzz, "getFMUstate", fmi2GetFMUstate(c, &state)) != fmi2OK) return NULL;
    if (answer(fuzz, "serializedFMUstateSize", fmi2SerializedFMUstateSize(c, state, size)) != fmi2OK) {
        give_up(fuzz, "serializedFMUstateSize", "refused a state of the instance");
    }
    bytes = malloc(*size);
    if (answer(fuzz, "serializeFMUstate", fmi2SerializeFMUstate(c, state, (fmi2Byte *)bytes, *size)) != fmi2OK) {
        give_up(fuzz, "serializeFMUstate", "refused a state of the instance");
    }
    answer(fuzz, "serializedFMUstateSize", fmi2SerializedFMUstateSize(c, chance(fuzz, 50) ? NULL : state, NULL));
    answer(fuzz, "serializeFMUstate", fmi2SerializeFMUstate(c, state, NULL, *size));
    answer(fuzz, "serializeFMUstate", fmi2SerializeFMUstate(c, NULL, (fmi2Byte *)bytes, *size));
    answer(fuzz, "freeFMUstate", fmi2FreeFMUstate(c, &state));
    return bytes;
}

/* Send the state of an instance as bytes and damage them on the way. */
void damage_state(Fuzz *fuzz, Slave *slave)
{
    fmi2Component c = slave->instance;
    fmi2FMUstate state = NULL;
    size_t size = 0, sent;
    unsigned char *bytes = bytes_of(fuzz, c, &size), *copy;
    int forged = fuzz->forge && chance(fuzz, 70), differs = 0;
    if (!bytes) return;
    sent = chance(fuzz, 80) ? size : (size_t)below(fuzz, size + 65);
    copy = calloc(sent ? sent : 1, 1); /* just so long: reading beyond it is noticed */
    memcpy(copy, bytes, sent < size ? sent : size);
    if (chance(fuzz, 90)) differs = damage(fuzz, copy, sent, STATE_CHECKSUM + 32, STATE_HEAD);
    if (forged && sent > STATE_CHECKSUM + 32) {
        digest(copy + STATE_CHECKSUM + 32, sent - STATE_CHECKSUM - 32, copy + STATE_CHECKSUM);
    }
    if (answer(fuzz, "deSerializeFMUstate", fmi2DeSerializeFMUstate(c, (fmi2Byte *)copy, sent, &state)) == fmi2OK) {
        if (sent != size || (differs && !forged)) give_up(fuzz, "deSerializeFMUstate", "took a damaged state");
        fuzz->forged_states += differs;
        answer(fuzz, "setFMUstate", fmi2SetFMUstate(c, state));
        answer(fuzz, "freeFMUstate", fmi2FreeFMUstate(c, &state));
    } else {
        fuzz->refused_states++;
        if (!differs && sent == size) give_up(fuzz, "deSerializeFMUstate", "refused a whole state");
    }
    if (state) give_up(fuzz, "deSerializeFMUstate", "left a state where it refused one");
    answer(fuzz, "deSerializeFMUstate", fmi2DeSerializeFMUstate(c, NULL, sent, &state));
    answer(fuzz, "deSerializeFMUstate", fmi2DeSerializeFMUstate(c, (fmi2Byte *)copy, sent, NULL));
    free(copy);
    free(bytes);
}
