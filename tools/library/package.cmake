# `cpack -G DEB` in a build folder of the preset release makes one package: README.md of this folder says why one.
set(CPACK_PACKAGE_NAME jarol)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "deterministic, time-triggered runtime for control software")
set(CPACK_PACKAGE_VENDOR "Jarol")
set(CPACK_PACKAGE_CONTACT "Jarol <jarol@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Control programs are graphs of isolated tasks: checked for schedulability, run the
 same to the bit every time, in simulation and in real time.")
# what the program needs, by dpkg-shlibdeps
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# and what find_package(jarol) needs to build a project: the compiler that built jarol, as plugins of another are refused,
# and the libraries that are linked
set(needs cmake make doctest-dev libcapstone-dev libdw-dev libeigen3-dev libfmt-dev liblz4-dev libsodium-dev libxxhash-dev
  libyaml-dev libzstd-dev nlohmann-json3-dev)
if(JAROL_VEHICLES)
  list(APPEND needs libsimbody-dev)
endif()
string(REGEX MATCH "^[0-9]+" major ${CMAKE_CXX_COMPILER_VERSION})
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  math(EXPR next "${major} + 1")
  list(APPEND needs "g++ (>= 4:${major})" "g++ (<< 4:${next})")
else()
  list(APPEND needs clang-${major})
endif()
list(JOIN needs ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "bash-completion, man-db")
include(CPack)
