# Writes the files of the pages as C++ constants: cmake -DFOLDER=... -DSOURCE=... "-DFILES=a.js;b.js" -P embed.cmake
set(text "// Made by the build.\n#include \"tools/pages/page_files.h\"\n\nnamespace jarol::tools {\n\nconst PageFile page_files[] = {\n")
foreach(file ${FILES})
  file(READ ${FOLDER}/${file} content)
  string(APPEND text "    {\"${file}\", R\"jarolpage(${content})jarolpage\"},\n")
endforeach()
string(APPEND text "};\nconst std::size_t page_file_count = sizeof page_files / sizeof page_files[0];\n\n}  // namespace jarol::tools\n")
file(WRITE ${SOURCE} "${text}")
