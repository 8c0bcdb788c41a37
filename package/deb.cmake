# deb.cmake - what `cpack -G DEB` makes of what is installed: one package with the command, the library, what is needed to build with it, and the
# package for Python.
# Debian's folders (lib/x86_64-linux-gnu) are those of CMAKE_INSTALL_PREFIX=/usr: the preset `package` says so.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "hbmcheck maintainers <maintainers@hbmcheck.invalid>")
set(CPACK_PACKAGE_DESCRIPTION "hbmcheck solves a one-degree-of-freedom oscillator on friction and gap contacts twice, by harmonic balance and by time
integration, and says per frequency how far the two are apart and what to make of it. For verifying
harmonic-balance results, for teaching what aliasing does, and as an accuracy gate in CI.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, python3, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "pkg-config, cmake, python3-matplotlib")
include(CPack)
