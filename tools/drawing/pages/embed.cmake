# Writes files as C++ constants: cmake -DFOLDER=... -DSOURCE=... "-DFILES=a.js;b.js" -DHEADER=... -DTYPE=PageFile
# -DNAME=page_file -P embed.cmake makes PageFile page_files[] and page_file_count, which the header declares.
set(text "// Made by the build.\n#include \"${HEADER}\"\n\nnamespace jarol::tools {\n\nconst ${TYPE} ${NAME}s[] = {\n")
foreach(file ${FILES})
  file(READ ${FOLDER}/${file} content)
  string(APPEND text "    {\"${file}\", R\"jarolpage(${content})jarolpage\"},\n")
endforeach()
string(APPEND text "};\nconst std::size_t ${NAME}_count = sizeof ${NAME}s / sizeof ${NAME}s[0];\n\n}  // namespace jarol::tools\n")
file(WRITE ${SOURCE} "${text}")
