#include "digest.h"

#include <stdint.h>
#include <string.h>

enum { BLOCK = 128 };

#if defined __GNUC__
#define ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define ALWAYS_INLINE inline
#endif

static const uint64_t START[8] = {
    UINT64_C(0x6a09e667f3bcc908), UINT64_C(0xbb67ae8584caa73b), UINT64_C(0x3c6ef372fe94f82b),
    UINT64_C(0xa54ff53a5f1d36f1), UINT64_C(0x510e527fade682d1), UINT64_C(0x9b05688c2b3e6c1f),
    UINT64_C(0x1f83d9abfb41bd6b), UINT64_C(0x5be0cd19137e2179),
};

/* Order of the message words in each of twelve rounds; the last two are as the first two. */
static const unsigned char ORDER[10][16] = {
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},
    {14, 10, 4, 8, 9, 15, 13, 6, 1, 12, 0, 2, 11, 7, 5, 3},
    {11, 8, 12, 0, 5, 2, 15, 13, 10, 14, 3, 6, 7, 1, 9, 4},
    {7, 9, 3, 1, 13, 12, 11, 14, 2, 6, 5, 10, 4, 0, 15, 8},
    {9, 0, 5, 7, 2, 4, 10, 15, 14, 1, 11, 12, 6, 8, 3, 13},
    {2, 12, 6, 10, 0, 11, 8, 3, 4, 13, 7, 5, 15, 14, 1, 9},
    {12, 5, 1, 15, 14, 13, 4, 10, 0, 7, 6, 3, 9, 2, 8, 11},
    {13, 11, 7, 14, 12, 1, 3, 9, 5, 0, 15, 4, 8, 6, 2, 10},
    {6, 15, 14, 9, 11, 3, 0, 8, 12, 2, 13, 7, 1, 4, 10, 5},
    {10, 2, 8, 4, 7, 6, 1, 5, 15, 11, 9, 14, 3, 12, 13, 0},
};

/* Turn a word to the right. */
static inline uint64_t turn(uint64_t word, int bits)
{
    return (word >> bits) | (word << (64 - bits));
}

/* Mix two message words into one column or diagonal; in line, or a model takes three times as long to read. */
static ALWAYS_INLINE void mix(uint64_t *a, uint64_t *b, uint64_t *c, uint64_t *d, uint64_t x, uint64_t y)
{
    *a += *b + x;
    *d = turn(*d ^ *a, 32);
    *c += *d;
    *b = turn(*b ^ *c, 24);
    *a += *b + y;
    *d = turn(*d ^ *a, 16);
    *c += *d;
    *b = turn(*b ^ *c, 63);
}

/* One round: columns, then diagonals. With a literal number its order of words costs nothing. */
static ALWAYS_INLINE void mix_round(uint64_t v[16], const uint64_t m[16], int number)
{
    const unsigned char *at = ORDER[number];
    mix(&v[0], &v[4], &v[8], &v[12], m[at[0]], m[at[1]]);
    mix(&v[1], &v[5], &v[9], &v[13], m[at[2]], m[at[3]]);
    mix(&v[2], &v[6], &v[10], &v[14], m[at[4]], m[at[5]]);
    mix(&v[3], &v[7], &v[11], &v[15], m[at[6]], m[at[7]]);
    mix(&v[0], &v[5], &v[10], &v[15], m[at[8]], m[at[9]]);
    mix(&v[1], &v[6], &v[11], &v[12], m[at[10]], m[at[11]]);
    mix(&v[2], &v[7], &v[8], &v[13], m[at[12]], m[at[13]]);
    mix(&v[3], &v[4], &v[9], &v[14], m[at[14]], m[at[15]]);
}

/* Take one block into the hash; so many bytes have then been read. */
static void compress(uint64_t hash[8], const unsigned char *block, uint64_t read, int last)
{
    uint64_t v[16], m[16];
    int i;
    memcpy(m, block, BLOCK); /* little-endian, as every platform of the library */
    for (i = 0; i < 8; i++) {
        v[i] = hash[i];
        v[i + 8] = START[i];
    }
    v[12] ^= read;
    if (last) v[14] = ~v[14];
    mix_round(v, m, 0);
    mix_round(v, m, 1);
    mix_round(v, m, 2);
    mix_round(v, m, 3);
    mix_round(v, m, 4);
    mix_round(v, m, 5);
    mix_round(v, m, 6);
    mix_round(v, m, 7);
    mix_round(v, m, 8);
    mix_round(v, m, 9);
    mix_round(v, m, 0);
    mix_round(v, m, 1);
    for (i = 0; i < 8; i++) hash[i] ^= v[i] ^ v[i + 8];
}

/* Write the digest of some bytes. */
void digest(const void *data, size_t size, unsigned char result[DIGEST_SIZE])
{
    const unsigned char *bytes = data;
    unsigned char end[BLOCK] = {0};
    uint64_t hash[8];
    size_t at = 0;
    memcpy(hash, START, sizeof hash);
    hash[0] ^= UINT64_C(0x01010000) ^ DIGEST_SIZE;
    for (; size - at > BLOCK; at += BLOCK) compress(hash, bytes + at, at + BLOCK, 0);
    if (size) memcpy(end, bytes + at, size - at);
    compress(hash, end, size, 1);
    memcpy(result, hash, DIGEST_SIZE);
}

/* Whether some bytes have a digest. */
int digest_holds(const void *data, size_t size, const unsigned char expected[DIGEST_SIZE])
{
    unsigned char found[DIGEST_SIZE];
    digest(data, size, found);
    return memcmp(found, expected, DIGEST_SIZE) == 0;
}
