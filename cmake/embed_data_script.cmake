# Writes a C++ file that defines vegard::sim::embedded_table(name) for the files in INPUTS. A name is that
# of the file, and of those in one of the FOLDERS also the folder's: "glow/atmosphere.csv".
cmake_minimum_required(VERSION 3.25)
set(body "")
foreach(path IN LISTS INPUTS)
  get_filename_component(name ${path} NAME)
  get_filename_component(folder ${path} DIRECTORY)
  get_filename_component(folder ${folder} NAME)
  if(folder IN_LIST FOLDERS)
    set(name ${folder}/${name})
  endif()
  file(READ ${path} text)
  string(APPEND body "  if (name == \"${name}\") return R\"csv(${text})csv\";\n")
endforeach()
file(WRITE ${OUTPUT} "// Made by cmake/embed_data_script.cmake from data/; do not edit.
#include \"sim/base/data_folders.h\"

namespace vegard::sim {

std::string_view embedded_table(std::string_view name) {
${body}  return {};
}

}  // namespace vegard::sim
")
