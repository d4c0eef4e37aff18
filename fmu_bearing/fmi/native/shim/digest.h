/* BLAKE2b (RFC 7693) with 32 bytes of result, as hashlib.blake2b(data, digest_size=32). */
#ifndef FB_DIGEST_H
#define FB_DIGEST_H

#include <stddef.h>

enum { DIGEST_SIZE = 32 };

/* Write the digest of some bytes. */
void digest(const void *data, size_t size, unsigned char result[DIGEST_SIZE]);

/* Whether some bytes have a digest. */
int digest_holds(const void *data, size_t size, const unsigned char expected[DIGEST_SIZE]);

#endif
