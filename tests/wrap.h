/* wrap.h - functions that a test puts in front of the library's own; the linker's --wrap=NAME, in the folder's
 * CMakeLists.txt, sends it the calls. */
#pragma once

/* WRAP(type, name, (parameters)) { ... }: the function that is called for `name`; the library's is __real_name. */
#define WRAP(type, name, parameters)                                                                                   \
  type __real_##name parameters;                                                                                       \
  type __wrap_##name parameters;                                                                                       \
  type __wrap_##name parameters
