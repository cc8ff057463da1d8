# What cmake --install puts in place, and how other projects find it: README.md of this folder.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(libraries jarol_math jarol_graph jarol_runtime jarol_tasks jarol_messages jarol_distributers jarol_library)
if(JAROL_VEHICLES)
  list(APPEND libraries jarol_vehicles)
endif()
foreach(library ${libraries})
  target_include_directories(${library} INTERFACE
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/jarol>)
endforeach()
# what changes results or layouts holds for those who include its headers, too
target_compile_features(jarol_graph INTERFACE cxx_std_20)
target_compile_options(jarol_graph INTERFACE $<INSTALL_INTERFACE:-ffp-contract=off>)
# plugins find what they use in the program that loads them
target_link_options(jarol_library INTERFACE $<INSTALL_INTERFACE:-rdynamic>)

install(TARGETS ${libraries} jarol EXPORT jarol)
# projects make message sets of their own by it
set_target_properties(jarol_message_generator PROPERTIES EXPORT_NAME message_generator)
install(TARGETS jarol_message_generator EXPORT jarol DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/jarol)
install(EXPORT jarol NAMESPACE jarol:: FILE targets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/jarol)
configure_package_config_file(tools/library/jarol-config.cmake.in ${PROJECT_BINARY_DIR}/jarol-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/jarol PATH_VARS CMAKE_INSTALL_DATADIR CMAKE_INSTALL_INCLUDEDIR)
# the binary interface is that of one version
write_basic_package_version_file(${PROJECT_BINARY_DIR}/jarol-config-version.cmake COMPATIBILITY ExactVersion)
install(FILES ${PROJECT_BINARY_DIR}/jarol-config.cmake ${PROJECT_BINARY_DIR}/jarol-config-version.cmake
  tools/library/jarol-functions.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/jarol)

# headers as in the tree, those that are made among them
foreach(folder graph runtime tasks distributers vehicles tools/library)
  install(DIRECTORY ${folder}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/jarol/${folder} FILES_MATCHING PATTERN *.h)
endforeach()
install(DIRECTORY ${PROJECT_BINARY_DIR}/made/distributers ${PROJECT_BINARY_DIR}/made/jarol/
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/jarol FILES_MATCHING PATTERN *.h)
install(DIRECTORY specs DESTINATION ${CMAKE_INSTALL_DATADIR}/jarol PATTERN broken EXCLUDE)
install(FILES graph/math/names.list DESTINATION ${CMAKE_INSTALL_DATADIR}/jarol/math)
install(DIRECTORY ${PROJECT_BINARY_DIR}/tools/made/manual/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN *.1)
install(FILES ${PROJECT_BINARY_DIR}/tools/made/manual/jarol DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# for the target uninstall
install(CODE "file(WRITE \"${PROJECT_BINARY_DIR}/install_prefix.txt\" \"\${CMAKE_INSTALL_PREFIX}\")")
add_custom_target(uninstall COMMENT "" COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR}
  -P ${PROJECT_SOURCE_DIR}/tools/library/uninstall.cmake)
