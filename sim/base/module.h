// Modules: shared libraries of vegard that are loaded when their functions are first called.
//
// OpenImageIO and most of OpenCV bring two hundred other libraries with them, OpenVDB 60 000 relocations, and
// loading these takes longer than all else that a short command does. What calls them is in modules, a file
// NAME_module.cpp each, so that only a command that needs such a library waits for it. A module has no state
// of vegard's and links none of its code: what crosses the border are plain values, and objects behind an
// abstract class.
#pragma once

#include <stdexcept>
#include <string>

namespace vegard::sim {

/// A module is not where it belongs, or cannot be loaded: a fault of the installation or the machine, not of
/// the user's input. what() names the file and the folders where it was looked for.
class MissingModule : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Loads NAME.so, from the folders of the run path of the program or library that this code is part of, and
/// returns what its VEGARD_MODULE() gives. Throws MissingModule.
const void* module_table(const std::string& name);

/// Returns the functions of a module, which is loaded by the first call; any thread may call it.
/// `Table::module` is the module's name. Throws MissingModule, at each call anew.
template <typename Table>
const Table& module_functions() {
  static const Table& table = *static_cast<const Table*>(module_table(Table::module));
  return table;
}

}  // namespace vegard::sim

/// In a module's file, once: `table` is an expression with the address of its functions.
#define VEGARD_MODULE(table)                                                                              \
  extern "C" __attribute__((visibility("default"))) const void* vegard_module_table() { return (table); } \
  static_assert(true, "for the semicolon")
