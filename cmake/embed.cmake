# Writes a function that returns files by their names: cmake -D OUT=FILE.cpp -D HEADER=apps/studio/studio_page.h
# -D FUNCTION=studio_pages -D FILES=A;B -P embed.cmake. The header declares it, with struct EmbeddedFile.
set(arrays "")
set(rows "")
set(number 0)
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" text "${hex}")
  string(LENGTH "${hex}" digits)
  math(EXPR size "${digits} / 2")
  string(APPEND arrays "constexpr char kFile_${FUNCTION}_${number}[] = \"${text}\";\n")
  string(APPEND rows "      {\"${name}\", {kFile_${FUNCTION}_${number}, ${size}}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUT} "// Made by cmake/embed.cmake.
#include \"${HEADER}\"

namespace vegard::apps {
namespace {
${arrays}}  // namespace

const std::vector<EmbeddedFile>& ${FUNCTION}() {
  static const std::vector<EmbeddedFile> files = {
${rows}  };
  return files;
}

}  // namespace vegard::apps
")
