/* Allocation that counts what is held and fails when told to; shim and toy are compiled onto it. */
#include <stddef.h>
#include <stdlib.h>

void *toy_malloc(size_t size);
void *toy_calloc(size_t count, size_t size);
void *toy_realloc(void *block, size_t size);
void toy_free(void *block);
__attribute__((visibility("default"))) void toy_fail_after(long count);
__attribute__((visibility("default"))) long toy_held(void);

static long left = -1; /* allocations until one fails, and all behind it; -1: none does */
static long held;

/* Let so many allocations succeed, -1 for all. */
void toy_fail_after(long count)
{
    left = count;
}

/* Blocks that were not given back. */
long toy_held(void)
{
    return held;
}

/* Whether the next allocation has to fail. */
static int fails(void)
{
    if (left > 0) left--;
    return left == 0;
}

void *toy_malloc(size_t size)
{
    void *block = fails() ? NULL : malloc(size);
    held += block != NULL;
    return block;
}

void *toy_calloc(size_t count, size_t size)
{
    void *block = fails() ? NULL : calloc(count, size);
    held += block != NULL;
    return block;
}

void *toy_realloc(void *block, size_t size)
{
    void *found = fails() ? NULL : realloc(block, size);
    held += !block && found;
    return found;
}

void toy_free(void *block)
{
    held -= block != NULL;
    free(block);
}
