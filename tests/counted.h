/* counted.h - every allocation of the process is counted: its own malloc and friends come before the C library's for
 * every shared library too (FFTW, SUNDIALS), and pass on to glibc's __libc_ entries. The sanitizers bring their own,
 * another C library has none to pass on to: then COUNTED is 0, and tests skip. For one file of a program. */
#pragma once

#include <errno.h>

#include "tests/check.h"

static long allocations;

#if defined __has_feature
#if __has_feature(address_sanitizer)
#define SANITIZED
#endif
#endif
#if defined __GLIBC__ && !defined __SANITIZE_ADDRESS__ && !defined SANITIZED
enum { COUNTED = 1 };

void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);
void *memalign(size_t align, size_t n);

void *malloc(size_t n) { return ++allocations, __libc_malloc(n); }
void *calloc(size_t n, size_t size) { return ++allocations, __libc_calloc(n, size); }
void *realloc(void *p, size_t n) { return ++allocations, __libc_realloc(p, n); }
void *memalign(size_t align, size_t n) { return ++allocations, __libc_memalign(align, n); }
void *aligned_alloc(size_t align, size_t n) { return memalign(align, n); }
int posix_memalign(void **p, size_t align, size_t n) { return (*p = memalign(align, n)) ? 0 : ENOMEM; }
#else
enum { COUNTED = 0 };
#endif
