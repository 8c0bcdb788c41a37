/* fftw_config.h - FFTW's config.h for WebAssembly: double precision, no vector instructions, no threads, no cycle
 * counter (plans are FFTW_ESTIMATE: nothing is timed). What ./configure would find out takes it minutes there. */
#define PACKAGE                   "fftw"
#define VERSION                   "3.3"
#define PACKAGE_VERSION           VERSION
#define FFTW_CC                   "emcc"
#define DISABLE_FORTRAN           1
#define FFTW_ENABLE_ALLOCA        1
#define HAVE_ALLOCA               1
#define HAVE_ALLOCA_H             1
#define HAVE_ABORT                1
#define HAVE_MALLOC_H             1
#define HAVE_MEMALIGN             1
#define HAVE_DECL_MEMALIGN        1
#define HAVE_STDINT_H             1
#define HAVE_STRING_H             1
#define HAVE_SYS_TYPES_H          1
#define HAVE_UINTPTR_T            1
#define HAVE_UNISTD_H             1
#define SIZEOF_FLOAT              4
#define SIZEOF_DOUBLE             8
#define SIZEOF_UNSIGNED_INT       4
#define SIZEOF_UNSIGNED_LONG      4
#define SIZEOF_UNSIGNED_LONG_LONG 8
