#include "model.h"

#include "path.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

static const char MAGIC[8] = {'f', 'b', 'm', 'o', 'd', 'e', 'l', '\n'};
static const uint64_t VERSION = 1;
static const uint64_t LARGEST = UINT64_C(1) << 24; /* numbers in s, z or w: 128 MB, far beyond any scene */
enum { MOST_CATEGORIES = 32, LONGEST_JOURNAL = 1000 };

/* Read a whole file; NULL with the reason. */
static void *read_all(FILE *file, size_t *size, const char **why)
{
    void *data = NULL;
    long length = -1;
    *why = "it cannot be read";
    if (fseek(file, 0, SEEK_END) == 0) length = ftell(file);
    if (length < 0 || length == LONG_MAX || fseek(file, 0, SEEK_SET) != 0) return NULL;
    *why = "it is too short";
    if ((size_t)length < sizeof(ModelHead)) return NULL;
    *why = "there is not enough memory";
    data = malloc((size_t)length);
    if (!data) return NULL;
    *why = "it cannot be read";
    if (fread(data, 1, (size_t)length, file) != (size_t)length) {
        free(data);
        return NULL;
    }
    *size = (size_t)length;
    return data;
}

/* Take a part of so many items off the file; NULL if it does not fit. */
static void *part(char **at, uint64_t *left, uint64_t count, size_t item)
{
    void *found = *at;
    if (count > *left / item) return NULL;
    *at += count * item;
    *left -= count * item;
    return found;
}

/* Find the parts; 0 if they do not fill the file exactly. */
static int find_parts(Model *model, size_t size)
{
    const ModelHead *head = model->head;
    char *at = (char *)model->head + sizeof *head;
    uint64_t left = size - sizeof *head;
    return (model->p = part(&at, &left, head->n_p, sizeof(double))) &&
           (model->u = part(&at, &left, head->n_u, sizeof(double))) &&
           (model->variables = part(&at, &left, head->n_variables, sizeof(ModelVariable))) &&
           (model->reasons = part(&at, &left, head->n_reasons, sizeof(ModelReason))) &&
           (model->cautions = part(&at, &left, head->n_cautions, sizeof(ModelCaution))) &&
           (model->categories = part(&at, &left, head->n_categories, sizeof(ModelCategory))) &&
           (model->texts = part(&at, &left, head->n_text, 1)) && left == 0 && head->n_text > 0 &&
           model->texts[head->n_text - 1] == '\0';
}

/* Whether a variable's numbers lie where they say. */
static int variable_fits(const ModelHead *head, const ModelVariable *variable)
{
    const uint64_t sizes[] = {0, head->n_u, head->n_z, head->n_tunables};
    int text = variable->type != TYPE_STRING || variable->array == ARRAY_NONE;
    return variable->type <= TYPE_STRING && variable->causality <= CAUSALITY_PARAMETER &&
           variable->variability <= VARIABILITY_TUNABLE && variable->array <= ARRAY_P && text &&
           (variable->causality != CAUSALITY_INPUT || variable->array == ARRAY_U) && /* rates are beside u */
           (variable->array == ARRAY_NONE || variable->index < sizes[variable->array]) &&
           variable->name < head->n_text && variable->unit < head->n_text && variable->text < head->n_text;
}

/* Whether every place named in the file is inside it. */
static int places_fit(const Model *model)
{
    const ModelHead *head = model->head;
    uint64_t i;
    if (head->n_s > LARGEST || head->n_w > LARGEST || head->n_z > LARGEST || head->time >= head->n_s ||
        head->journal < 1 || head->journal > LONGEST_JOURNAL || head->n_tunables > head->n_p ||
        head->n_categories > MOST_CATEGORIES || head->guid >= head->n_text) {
        return 0;
    }
    for (i = 0; i < head->n_variables; i++) {
        if (!variable_fits(head, &model->variables[i])) return 0;
    }
    for (i = 0; i < head->n_reasons; i++) {
        if (model->reasons[i].text >= head->n_text) return 0;
    }
    for (i = 0; i < head->n_cautions; i++) {
        const ModelCaution *caution = &model->cautions[i];
        uint64_t size = caution->array == ARRAY_U ? head->n_u : caution->array == ARRAY_Z ? head->n_z : 0;
        if (caution->index >= size || caution->before >= head->n_text ||
            caution->after >= head->n_text || caution->decimals > 17) {
            return 0;
        }
    }
    for (i = 0; i < head->n_categories; i++) {
        if (model->categories[i].name >= head->n_text) return 0;
    }
    if (head->tolerance == MODEL_NOWHERE) return 1;
    return head->tolerance < head->n_variables && model->variables[head->tolerance].type == TYPE_REAL;
}

/* Whether a hash in the file is that in hexadecimal digits. */
static int same_hash(const unsigned char hash[DIGEST_SIZE], const char *digits)
{
    const char *names = "0123456789abcdef";
    int i;
    if (strlen(digits) != 2 * DIGEST_SIZE) return 0;
    for (i = 0; i < DIGEST_SIZE; i++) {
        if (digits[2 * i] != names[hash[i] >> 4] || digits[2 * i + 1] != names[hash[i] & 15]) return 0;
    }
    return 1;
}

/* What is wrong with a file that was read, NULL if nothing. */
static const char *objection(Model *model, size_t size, const char *kernels)
{
    const ModelHead *head = model->head;
    const char *covered = (const char *)head->kernels;
    size_t before = (size_t)(covered - (const char *)head);
    if (memcmp(head->magic, MAGIC, sizeof MAGIC) != 0) return "it is not a model file";
    if (head->version != VERSION) return "it was written for another version of this library: rebuild the FMU";
    if (!digest_holds(covered, size - before, head->checksum)) {
        return "it is damaged or cut off: its checksum does not hold; unpack the FMU again";
    }
    if (!same_hash(head->kernels, kernels)) {
        return "it was built for other equations than those in this library: rebuild the FMU";
    }
    if (!find_parts(model, size) || !places_fit(model)) return "its parts do not fit together: rebuild the FMU";
    return NULL;
}

/* Read the model beside the library. */
int model_read(Model *model, const char *location, const char *kernels, Text *why)
{
    Text path = {0};
    const char *problem = NULL;
    size_t size = 0;
    FILE *file = path_open(location, MODEL_FILE, &path, why);
    memset(model, 0, sizeof *model);
    if (file) {
        model->head = read_all(file, &size, &problem);
        fclose(file);
        if (model->head) problem = objection(model, size, kernels);
        if (problem) {
            text_add(why, text_string(&path), " cannot be used: ", problem, NULL);
            model_free(model);
        }
    }
    text_free(&path);
    return model->head != NULL;
}

/* Give the memory back. */
void model_free(Model *model)
{
    free(model->head);
    memset(model, 0, sizeof *model);
}

/* A text of the model. */
const char *model_text(const Model *model, uint64_t offset)
{
    return model->texts + offset;
}

/* Append what a status of the kernels means. */
void model_add_reason(const Model *model, int32_t status, Text *text)
{
    uint64_t i;
    for (i = 0; i < model->head->n_reasons; i++) {
        if (model->reasons[i].status == (uint32_t)status) {
            text_add(text, model_text(model, model->reasons[i].text), NULL);
            return;
        }
    }
    text_add(text, "the engine refused with status ", NULL);
    text_add_number(text, status, 9);
}
