/* run.h - a page written by the built command. */
#pragma once

#include "tests/folder.h"
#include "tests/program.h"

/* A comparison of two frequencies, tables of two orders: what a page has, in a second. */
#define CASE2  "cases/paper/case2.yaml"
#define TABLES " --harmonics 1,5 --samples 32,512 -q "
#define SMALL  " --at 8,9" TABLES
