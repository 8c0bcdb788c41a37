/* store_private.h - what store.c and store_table.c share. */
#ifndef HC_STUDY_STORE_PRIVATE_H
#define HC_STUDY_STORE_PRIVATE_H

#include "study/store.h"

struct study_store { /* from study_store_open, to study_store_close */
  const study *s;    /* the caller's */
  sqlite3 *db;
  int lock; /* file descriptor that holds the flock; -1 for :memory: */
  sqlite3_stmt *put_scene, *put_row;
};

/* CREATE TABLE ... for the study, to free; NULL when out of memory. */
char *store_schema(const study *s, int application_id);

bool store_prepare(study_store *st);
void store_unprepare(study_store *st);

#endif
