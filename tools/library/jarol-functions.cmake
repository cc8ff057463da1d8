# What a project of one's own calls. Flags are set here once, as a library and the jarol that loads it have to agree in
# layout and arithmetic.

# The compiler that built jarol; plugins of another are refused when they are loaded, so say it at once.
function(_jarol_require_compiler)
  if(NOT "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" STREQUAL jarol_COMPILER)
    message(FATAL_ERROR "jarol was built by ${jarol_COMPILER}, and this project has ${CMAKE_CXX_COMPILER_ID} "
      "${CMAKE_CXX_COMPILER_VERSION}; begin with an empty build folder and -DCMAKE_CXX_COMPILER=... of the same")
  endif()
endfunction()

# Standard, warnings and arithmetic of all code of a project; optimised where no build type says otherwise.
function(_jarol_compile target)
  target_compile_features(${target} PRIVATE cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # by g++ alone constants of two plugins would be one
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra $<$<CONFIG:>:-O2> $<$<CONFIG:>:-g>)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()

# jarol_add_plugin(NAME SOURCE... [MESSAGES SET.xml...] [WEAK]): a shared library NAME.so in the build folder, which a
# graph names as `plugins: [build/NAME.so]`. Each message set becomes C++, included as "messages/SET.h". After it is built,
# `jarol isolation` looks at what its tasks reach, and the build fails if that is not their own; WEAK: it is not looked at.
function(jarol_add_plugin name)
  cmake_parse_arguments(PARSE_ARGV 1 arg WEAK "" MESSAGES)
  _jarol_require_compiler()
  if(NOT arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "jarol_add_plugin(${name}): it has no sources; name at least that with JAROL_PLUGIN")
  endif()
  add_library(${name} MODULE ${arg_UNPARSED_ARGUMENTS})
  _jarol_compile(${name})
  # headers alone: what is called stands in the program that loads it
  target_include_directories(${name} SYSTEM PRIVATE $<TARGET_PROPERTY:jarol::graph,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(${name} PRIVATE Eigen3::Eigen)
  set_target_properties(${name} PROPERTIES PREFIX "" OUTPUT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}
    INTERPROCEDURAL_OPTIMIZATION OFF)
  if(arg_MESSAGES)
    _jarol_message_sets(${name} ${arg_MESSAGES})
  endif()
  set_property(GLOBAL APPEND PROPERTY JAROL_PLUGINS ${name})
  if(NOT arg_WEAK)
    set(stamp ${CMAKE_CURRENT_BINARY_DIR}/${name}.isolated)
    add_custom_command(OUTPUT ${stamp} DEPENDS ${name} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
      COMMAND jarol::command isolation $<PATH:RELATIVE_PATH,$<TARGET_FILE:${name}>,${CMAKE_SOURCE_DIR}>
      COMMAND ${CMAKE_COMMAND} -E touch ${stamp} COMMENT "Looking at what the tasks of ${name} reach" VERBATIM)
    add_custom_target(${name}_isolation ALL DEPENDS ${stamp})
  endif()
endfunction()

# The C++ of message sets, made before the target is compiled.
function(_jarol_message_sets target)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_made)
  set(made)
  set(definitions)
  foreach(definition ${ARGN})
    cmake_path(ABSOLUTE_PATH definition BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    cmake_path(GET definition STEM set)
    if(EXISTS ${jarol_INCLUDE}/jarol/distributers/messages/${set}.h)
      message(FATAL_ERROR "${definition}: jarol has a message set '${set}'; it needs another name")
    endif()
    list(APPEND definitions ${definition})
    list(APPEND made ${folder}/distributers/messages/${set}.cpp ${folder}/distributers/messages/${set}.h)
  endforeach()
  file(MAKE_DIRECTORY ${folder}/distributers/messages)
  # what has not changed is left alone, so a stamp records that it was looked at
  add_custom_command(OUTPUT ${folder}/stamp BYPRODUCTS ${made} DEPENDS ${definitions} jarol::message_generator
    COMMAND jarol::message_generator ${folder}/distributers/messages ${definitions}
    COMMAND ${CMAKE_COMMAND} -E touch ${folder}/stamp COMMENT "Making message sets of ${target}" VERBATIM)
  target_sources(${target} PRIVATE ${made} ${folder}/stamp)
  target_include_directories(${target} PRIVATE ${folder} ${folder}/distributers)
  set_property(SOURCE ${made} PROPERTY OBJECT_DEPENDS ${folder}/stamp)
  set_property(GLOBAL APPEND PROPERTY JAROL_MESSAGE_FOLDERS ${folder} ${folder}/distributers)
endfunction()

# jarol_add_tests(NAME SOURCE...): a doctest suite that opens graphs by <jarol/session.h>; CTest runs it in the folder of
# its CMakeLists.txt once all plugins are built.
function(jarol_add_tests name)
  _jarol_require_compiler()
  find_package(doctest QUIET)
  if(NOT doctest_FOUND)
    message(FATAL_ERROR "jarol_add_tests(${name}) needs doctest: install the package doctest-dev")
  endif()
  add_executable(${name} ${ARGN})
  _jarol_compile(${name})
  target_link_libraries(${name} PRIVATE jarol::jarol doctest::doctest)
  # plugins find what they use in the program that loads them
  set_target_properties(${name} PROPERTIES ENABLE_EXPORTS ON)
  get_property(plugins GLOBAL PROPERTY JAROL_PLUGINS)
  get_property(messages GLOBAL PROPERTY JAROL_MESSAGE_FOLDERS)
  if(plugins)
    add_dependencies(${name} ${plugins})
  endif()
  target_include_directories(${name} PRIVATE ${messages})
  add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()
