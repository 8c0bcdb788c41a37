/* random.h - random numbers for stress scenes and tests: splitmix64 (Steele, Lea, Flood 2014), good in all 64 bits and
 * for any seed. The caller holds the seed, so that runs are reproducible on every machine. */
#pragma once

#include <stdint.h>

static inline uint64_t random_bits(uint64_t *seed)
{
  uint64_t z = *seed += 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/* low..high, both included; uniform for ranges far below 2^64. */
static inline int random_int(uint64_t *seed, int low, int high)
{
  return (int)(low + (int64_t)(random_bits(seed) % (uint64_t)((int64_t)high - low + 1)));
}

/* [0, 1), multiples of 2^-53. */
static inline double random_unit(uint64_t *seed) { return (double)(random_bits(seed) >> 11) * 0x1p-53; }

/* [-1, 1), multiples of 2^-52. */
static inline double random_signed(uint64_t *seed) { return 2 * random_unit(seed) - 1; }
