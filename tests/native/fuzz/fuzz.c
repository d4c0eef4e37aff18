/* fuzz GUID FOLDER BAD-FOLDER VARIABLES STEP FORGE SEED ROUNDS: so many rounds of random calls.
 *
 * FOLDER holds model.bin; a damaged copy is written to BAD-FOLDER again and again. FORGE 1: also damage
 * that has the right checksum. Leaves with 0 and prints what happened, or with 1 and what the library did
 * wrong; what happens depends on the arguments alone. */
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CALLS = 150, PROBED = 200 };

/* Read the good file. */
static void read_model(Fuzz *fuzz)
{
    char path[MOST_PATH + 20];
    FILE *file;
    snprintf(path, sizeof path, "%s/model.bin", fuzz->good);
    file = fopen(path, "rb");
    if (!file) give_up(fuzz, path, "cannot be read");
    fseek(file, 0, SEEK_END);
    fuzz->model_size = (size_t)ftell(file);
    fseek(file, 0, SEEK_SET);
    fuzz->model = malloc(fuzz->model_size);
    if (fread(fuzz->model, 1, fuzz->model_size, file) != fuzz->model_size) give_up(fuzz, path, "cannot be read");
    fclose(file);
}

/* What an instance shows after a start and a step; the answers themselves do not matter. */
static void probe(Fuzz *fuzz, fmi2Component c, double *shown)
{
    fmi2ValueReference reference;
    memset(shown, 0, PROBED * sizeof *shown);
    fmi2SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    fmi2EnterInitializationMode(c);
    fmi2ExitInitializationMode(c);
    fmi2DoStep(c, 0.0, fuzz->usual_step, fmi2True);
    for (reference = 0; reference < fuzz->n_variables && reference < PROBED; reference++) {
        fmi2GetReal(c, &reference, 1, &shown[reference]);
    }
}

/* After all that was done to it, an instance that is reset is as a fresh one. */
static void compare(Fuzz *fuzz, Slave *slave)
{
    double used[PROBED], fresh[PROBED];
    Slave other = {0};
    if (answer(fuzz, "reset", fmi2Reset(slave->instance)) != fmi2OK) give_up(fuzz, "reset", "was refused");
    other.instance = make(fuzz, fuzz->good, 0);
    if (!other.instance) give_up(fuzz, "instantiate", "refused the good model");
    probe(fuzz, slave->instance, used);
    probe(fuzz, other.instance, fresh);
    if (memcmp(used, fresh, sizeof used) != 0) give_up(fuzz, "reset", "left something of what was before");
    drop(fuzz, &other);
}

/* One round: an instance, random calls, and a damaged file. */
static void play(Fuzz *fuzz)
{
    Slave slave = {0};
    fmi2Component strange = make(fuzz, fuzz->good, 1);
    int i;
    if (strange) fmi2FreeInstance(strange);
    fmi2FreeInstance(NULL);
    slave.instance = make(fuzz, fuzz->good, 0);
    if (!slave.instance) give_up(fuzz, "instantiate", "refused the good model");
    for (i = 0; i < CALLS; i++) call_something(fuzz, &slave);
    compare(fuzz, &slave);
    drop(fuzz, &slave);
    for (i = 0; i < 10; i++) damage_model(fuzz);
}

/* Play so many rounds. */
int main(int argc, char **argv)
{
    Fuzz fuzz;
    long round, rounds;
    memset(&fuzz, 0, sizeof fuzz);
    if (argc != 9 || strlen(argv[2]) >= MOST_PATH || strlen(argv[3]) >= MOST_PATH - 20) {
        fprintf(stderr, "usage: fuzz GUID FOLDER BAD-FOLDER VARIABLES STEP FORGE SEED ROUNDS\n");
        return 2;
    }
    fuzz.guid = argv[1];
    strcpy(fuzz.good, argv[2]);
    strcpy(fuzz.bad, argv[3]);
    snprintf(fuzz.bad_file, sizeof fuzz.bad_file, "%s/model.bin", argv[3]);
    fuzz.n_variables = strtoul(argv[4], NULL, 10);
    fuzz.usual_step = strtod(argv[5], NULL);
    fuzz.forge = strtol(argv[6], NULL, 10) != 0;
    fuzz.luck = strtoull(argv[7], NULL, 10) * 2 + 1;
    rounds = strtol(argv[8], NULL, 10);
    read_model(&fuzz);
    for (round = 0; round < rounds; round++) play(&fuzz);
    free(fuzz.model);
    printf("ok=%ld warning=%ld discard=%ld error=%ld logged=%ld steps=%ld discarded_steps=%ld forged_models=%ld "
           "refused_models=%ld forged_states=%ld refused_states=%ld\n",
           fuzz.answers[0], fuzz.answers[1], fuzz.answers[2], fuzz.answers[3], fuzz.logged, fuzz.steps,
           fuzz.discarded_steps, fuzz.forged_models, fuzz.refused_models, fuzz.forged_states,
           fuzz.refused_states);
    return 0;
}
