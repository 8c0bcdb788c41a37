# deb.cmake - what `cpack --preset package` makes of what is installed: four packages, as Debian has them.
#     hbmcheck          command       the command, its manual page, completion, example cases
#     libhbmcheckN      library       the shared library; N is its soname's number
#     libhbmcheck-dev   development   header, pkg-config file, CMake package
#     python3-hbmcheck  python        the package for Python, over the library
# Debian's folders (lib/x86_64-linux-gnu) are those of CMAKE_INSTALL_PREFIX=/usr: the preset `package` says so. `changelog` is Debian's: its first
# line has the version, which is the project's and the number of the package made of it.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGE_CONTACT "hbmcheck maintainers <maintainers@hbmcheck.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # it would stand before each package's own
set(CPACK_COMPONENTS_ALL command library development)
if(HBMCHECK_PYTHON_FOLDER)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS interfaces/package/changelog interfaces/library/abi.txt)
file(STRINGS interfaces/package/changelog debian_version LIMIT_COUNT 1)
string(REGEX REPLACE ".*\\((.*)\\).*" "\\1" debian_version "${debian_version}")
if(NOT debian_version MATCHES "^${PROJECT_VERSION}-[0-9]+$")
  message(FATAL_ERROR "interfaces/package/changelog: ${debian_version}, expected ${PROJECT_VERSION}-NUMBER")
endif()
string(REGEX REPLACE ".*-" "" CPACK_DEBIAN_PACKAGE_RELEASE "${debian_version}")
get_target_property(soname hbmcheck_library SOVERSION)
set(library_package libhbmcheck${soname})

# ---- names, what they depend on, what they are ----

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME hbmcheck)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS "gnuplot-nox")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "libhbmcheck-dev, python3-hbmcheck")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "libopenblas0-pthread | libopenblas0")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS "hbmcheck") # hbmcheck-proof decides for prove
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libhbmcheck-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_package} (= ${debian_version})")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "pkgconf, cmake")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-hbmcheck)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${library_package} (>= ${PROJECT_VERSION}), python3-numpy, python3:any")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib")

set(what "hbmcheck solves an oscillator, or a structure, on friction and gap contacts
twice, by harmonic balance and by time integration, and says per frequency
how far the two are apart and what to make of it: for verifying results of
harmonic balance, those of other programs too, for teaching what aliasing
does, and as an accuracy gate in continuous integration.
.
")
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "tells whether a harmonic-balance result is right
${what}This package has the command and example cases.")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "tells whether a harmonic-balance result is right - shared library
${what}This package has the shared library.")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "tells whether a harmonic-balance result is right - development files
${what}This package has what is needed to build programs with the library.")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "tells whether a harmonic-balance result is right - Python 3
${what}This package has the package for Python 3, with results as NumPy arrays.")

# ---- what dpkg is told of the library, and does with the byte code ----

# A postinst that is named and not there keeps CPack from writing one that calls ldconfig: the trigger does.
file(STRINGS interfaces/library/abi.txt functions REGEX "^function ")
list(TRANSFORM functions REPLACE "^function ([a-z0-9_]+):.* = ([^ ]+)$" " \\1@Base \\2")
list(JOIN functions "\n" functions)
set(control ${PROJECT_BINARY_DIR}/package/control)
file(WRITE ${control}/symbols "libhbmcheck.so.${soname} ${library_package} #MINVER#\n* Build-Depends-Package: libhbmcheck-dev\n${functions}\n")
file(WRITE ${control}/shlibs "libhbmcheck ${soname} ${library_package} (>= ${PROJECT_VERSION})\n")
file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${control}/symbols ${control}/shlibs ${control}/triggers ${control}/none/postinst ${control}/none/postrm)
foreach(script postinst prerm)
  configure_file(interfaces/package/python3-hbmcheck.${script} ${control}/${script} COPYONLY)
  list(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${control}/${script})
endforeach()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Every package has a folder of its own in share/doc; `cmake --install` needs one only.
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} of)
  set(folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_DEBIAN_${of}_PACKAGE_NAME})
  install(FILES interfaces/package/copyright ${PROJECT_BINARY_DIR}/interfaces/package/changelog.Debian.gz DESTINATION ${folder} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
include(CPack)
