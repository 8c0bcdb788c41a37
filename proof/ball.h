/* ball.h - FLINT's balls: a number of type arb_t is a midpoint and a radius, and every result contains what it would be for all
 * numbers in its operands. The headers moved when Arb (Debian 12) became a part of FLINT 3 (Debian 13). */
#ifndef HC_PROOF_BALL_H
#define HC_PROOF_BALL_H

#if __has_include(<flint/arb.h>)
#include <flint/acb_mat.h>
#include <flint/arb_mat.h>
#include <flint/arb_poly.h>
#include <flint/fmpq.h>
#include <flint/fmpq_vec.h>
#else
#include <acb_mat.h>
#include <arb_mat.h>
#include <arb_poly.h>
#include <flint/fmpq.h>
#include <flint/fmpq_vec.h>
#endif

#endif
