# exports.cmake - cmake -DHEADERS=... -DOUTPUT=FILE -P exports.cmake: what the shared library exports is what its public headers declare.
# A declaration begins in the first column with its type, as everywhere here; inline functions (static) and typedefs are none. What this misses
# or makes up, tests/install/abi.sh sees.
foreach(header IN LISTS HEADERS)
  file(READ ${header} text)
  string(REGEX MATCHALL "\n[a-z][a-z0-9_ ]*[ *][a-z][a-z0-9_]*\\(" declarations "${text}")
  list(FILTER declarations EXCLUDE REGEX "\n(static|typedef) ")
  list(TRANSFORM declarations REPLACE ".*[ *]([a-z][a-z0-9_]*)\\($" "\\1")
  list(APPEND functions ${declarations})
endforeach()
list(JOIN functions ";\n  " functions)
file(WRITE ${OUTPUT} "{\nglobal:\n  ${functions};\nlocal: *;\n};\n")
