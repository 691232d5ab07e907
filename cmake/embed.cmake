# Writes apps/studio/studio_page.h's studio_pages(): cmake -D OUT=FILE.cpp -D FILES=A;B -P embed.cmake
set(arrays "")
set(rows "")
set(number 0)
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" text "${hex}")
  string(LENGTH "${hex}" digits)
  math(EXPR size "${digits} / 2")
  string(APPEND arrays "constexpr char kFile${number}[] = \"${text}\";\n")
  string(APPEND rows "      {\"${name}\", {kFile${number}, ${size}}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUT} "// Made by cmake/embed.cmake.
#include \"apps/studio/studio_page.h\"

namespace vegard::apps {
namespace {
${arrays}}  // namespace

const std::vector<StudioPage>& studio_pages() {
  static const std::vector<StudioPage> pages = {
${rows}  };
  return pages;
}

}  // namespace vegard::apps
")
