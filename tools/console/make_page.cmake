# Builds the page by npm in the folder WORK and embeds its files in the C++ file MADE: cmake -DNPM=... -DWEB=... -DWORK=...
# -DMADE=... -DSTAMP=... -P make_page.cmake. Without npm, or where it can't fetch what it needs, the page says so; STAMP is
# made unless the next build shall try again.
set(dist "")
set(done TRUE)
if(NPM)
  file(REMOVE_RECURSE ${WORK}/src ${WORK}/tests ${WORK}/made ${WORK}/dist)
  file(COPY ${WEB}/ DESTINATION ${WORK} PATTERN node_modules EXCLUDE PATTERN dist EXCLUDE PATTERN made EXCLUDE)
  file(SHA256 ${WEB}/package-lock.json lock)
  set(installed "")
  if(EXISTS ${WORK}/node_modules/.jarol)
    file(READ ${WORK}/node_modules/.jarol installed)
  endif()
  if(NOT installed STREQUAL lock)
    execute_process(COMMAND ${NPM} ci --prefer-offline --ignore-scripts --no-audit --no-fund --fetch-retries 1 --fetch-timeout 20000
      WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed OUTPUT_VARIABLE words ERROR_VARIABLE words)
    if(failed)
      set(done FALSE)
      message("note: npm can't fetch what the page of the console needs; until the next build it is a page that says so\n${words}")
    else()
      file(WRITE ${WORK}/node_modules/.jarol ${lock})
      set(installed ${lock})
    endif()
  endif()
  if(installed STREQUAL lock)
    execute_process(COMMAND ${NPM} run --silent build WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed
      OUTPUT_VARIABLE words ERROR_VARIABLE words)
    if(failed)
      message(FATAL_ERROR "the page of the console does not build:\n${words}")
    endif()
    set(dist ${WORK}/dist)
  endif()
endif()
if(NOT dist)
  set(dist ${WORK}/without)
  file(REMOVE_RECURSE ${dist})
  file(MAKE_DIRECTORY ${dist})
  file(COPY_FILE ${WEB}/without.html ${dist}/edit.html)
  file(COPY_FILE ${WEB}/without.html ${dist}/index.html)
endif()

set(type_html "text/html; charset=utf-8")
set(type_js "text/javascript; charset=utf-8")
set(type_css "text/css; charset=utf-8")
set(type_svg "image/svg+xml")
file(GLOB_RECURSE files RELATIVE ${dist} ${dist}/*)
list(SORT files)
set(arrays "")
set(rows "")
set(number 0)
foreach(file IN LISTS files)
  set(path "/${file}")
  set(gzip false)
  if(path MATCHES "\\.gz$")
    set(gzip true)
    string(REGEX REPLACE "\\.gz$" "" path "${path}")
  endif()
  string(REGEX REPLACE "^.*\\." "" ending "${path}")
  if(NOT DEFINED type_${ending})
    message(FATAL_ERROR "the page has a file of an unknown type: ${file}")
  endif()
  set(type "${type_${ending}}")
  if(path STREQUAL "/index.html")
    set(path "/")
  endif()
  file(SHA256 ${dist}/${file} hash)
  string(SUBSTRING ${hash} 0 16 etag)
  file(READ ${dist}/${file} hex HEX)
  string(REGEX REPLACE "(................................................)" "\\1\n" lines "${hex}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${lines}")
  string(APPEND arrays "const unsigned char file_${number}[] = {\n${bytes}};\n")
  string(APPEND rows "    {\"${path}\", \"${type}\", \"\\\"${etag}\\\"\", text(file_${number}), ${gzip}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(CONFIGURE OUTPUT ${MADE} CONTENT "// made by tools/console/make_page.cmake
#include <array>
#include <cstddef>

#include \"tools/console/page.h\"

namespace jarol::tools::console {
namespace {

${arrays}
template <std::size_t N>
std::string_view text(const unsigned char (&bytes)[N]) {
  return {reinterpret_cast<const char*>(bytes), N};
}

}  // namespace

std::span<const PageFile> page_files() {
  static const std::array<PageFile, ${number}> files{{
${rows}  }};
  return files;
}

}  // namespace jarol::tools::console
" @ONLY)
if(done)
  file(TOUCH ${STAMP})
endif()
