/* matlab_layout.h - is a variable of a MATLAB file of version 5 all there? libmatio, asked for numbers beyond the end
 * of the file or of an element, answers "read" with what memory held before; and it does not look at the checksum of
 * what is compressed. So the file is walked here, from variable to variable, to the one of interest, whose parts must
 * be as long as its dimensions ask, and whose checksum must hold.
 * The format: "MAT-File Format", The MathWorks, chapter "Level 5 MAT-File Format". */
#ifndef HC_MATLAB_LAYOUT_H
#define HC_MATLAB_LAYOUT_H

#include "base/message.h"
#include "base/status.h"

/* The file at `path`, of version 5, up to the end of the first variable called `name`, or if NULL of the first one; to
 * the end of the file if there is none. HC_OK: without damage as far as can be seen. HC_BAD_INPUT with words in m as
 * in matlab_file.h. */
hc_status matlab_layout_check(const char *path, const char *name, message *m);

#endif
