// The command line for the subcommands: options, flags and their checks. It wraps CLI11, which is compiled in
// command.cpp alone.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class Option;
}  // namespace CLI

namespace vegard::apps {

/// Thrown when a command finds no memory for its work; says what was done, and how to need less.
class OutOfMemory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An option of a subcommand, by reference: copies are the same option. It lives as long as its Program. All
/// setters return the option itself.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  const Option& required() const;
  /// Name of its value in the help: "OUT.exr".
  const Option& type_name(const std::string& name) const;
  /// Replaces the description in the help.
  const Option& description(const std::string& words = {}) const;
  /// Shows the present value in the help as the default.
  const Option& shows_default() const;

  /// Both ends included.
  const Option& range(int low, int high) const;
  const Option& range(std::uint64_t low, std::uint64_t high) const;
  /// It accepts "nan", which is neither below nor above any number: see finite_range().
  const Option& range(double low, double high) const;
  /// The same, but it refuses "nan".
  const Option& finite_range(double low, double high) const;
  const Option& one_of(std::initializer_list<const char*> words) const;
  const Option& one_of(std::initializer_list<int> numbers) const;
  /// `complaint` returns what is wrong with a value, or nothing if it is valid; `type` is the name of such
  /// values in the help.
  const Option& check(const std::function<std::string(const std::string& word)>& complaint,
                      const std::string& type) const;

  /// Splits a word into several values.
  const Option& delimiter(char separator) const;
  /// Number of values that it takes; below 0: at least that many.
  const Option& expected(int count) const;
  const Option& expected(int least, int most) const;
  /// One value (or one list with delimiters) per occurrence; without this it would take the arguments after
  /// it, too.
  const Option& one_an_occurrence() const;
  /// One value per occurrence; the values of all occurrences are kept.
  const Option& repeated() const;

  const Option& excludes(const Option& other) const;
  const Option& needs(const Option& other) const;
  const Option& needs(const std::string& other) const;

  /// Whether it was given; known once the command line is read.
  bool given() const;
  /// Name in messages: "--voxel".
  std::string name() const;

  bool operator==(const Option& other) const { return option_ == other.option_; }

 private:
  CLI::Option* option_;
};

/// A subcommand, by reference like Option. Variables to which options write must outlive the parsing.
class Command {
 public:
  Command(CLI::App* app, int* exit_code) : app_(app), exit_code_(exit_code) {}

  /// `names`: "-o,--output", or "SCENE" for a positional argument. `words` is the description in the help.
  /// The value is a text, an int, a std::uint64_t or a double, one of these numbers as an optional, a vector
  /// of texts, ints or doubles, or a vector of lists of texts: one list for each occurrence.
  template <class Value>
  Option option(const std::string& names, Value& value, const std::string& words = {}) const;
  Option flag(const std::string& names, bool& value, const std::string& words = {}) const;

  /// Adds a subcommand to this command, which from then on requires one.
  Command add(const std::string& name, const std::string& description) const;

  /// Returns an option that was added before.
  Option option_of_name(const std::string& name) const;

  /// The options in the order of the command line, each as often as it was given; known once the command line
  /// is read.
  std::vector<Option> order() const;

  /// Sets the function that does the work and returns the program's exit code. If it runs out of memory, in
  /// any thread, OutOfMemory is thrown.
  void runs(std::function<int()> call) const;

 private:
  CLI::App* app_;
  int* exit_code_;
};

/// Adds --threads: an option of whatever is computed by several threads, with the same result.
Option add_threads_option(const Command& command, int& threads);

/// The texts of an option, for manuals.
struct OptionText {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional argument its name alone, "SCENE"
  std::string value;                 ///< name of its value in the help; empty: a flag
  std::vector<std::string> choices;  ///< the allowed values, if they are few
  std::string words;
  bool by_place = false, required = false;
};

/// The texts of a subcommand, or of the whole program.
struct CommandText {
  std::string name;   ///< "survey run"; for the program itself its own name
  std::string group;  ///< title under which the help lists it
  std::string words;
  std::vector<OptionText> options;
  std::vector<CommandText> subcommands;
};

/// The whole command line. Options and subcommands are added before it is read.
class Program {
 public:
  /// `versions` is what --version prints; without it there is no such option.
  Program(const std::string& name, const std::string& description,
          const std::function<std::string()>& versions, int argc, const char* const* argv);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Begins a group of subcommands in the help; those added from here on belong to it.
  void begin_group(const std::string& title);

  /// A subcommand.
  Command add(const std::string& name, const std::string& description);

  /// Returns the command for options that are given without a subcommand.
  Command root();

  /// Returns the texts of all commands and options that have been added.
  CommandText text() const;

  /// Makes read() accept arguments that no option takes.
  void takes_more();

  /// The program's name without its folder and the arguments as given, quoted where a shell would need it:
  /// for the provenance of a result.
  std::string command_line() const;

  /// Parses, and calls the subcommand if there is one. Returns the exit code if the program must end here:
  /// after --help or --version, or after a wrong command line, which is reported on standard error. Throws
  /// what the subcommand throws.
  std::optional<int> read();

  /// read() for a program that requires a subcommand; returns the exit code.
  int run();

 private:
  std::unique_ptr<CLI::App> app_;
  std::string group_;
  int argc_;
  const char* const* argv_;
  int exit_code_ = 0;
};

}  // namespace vegard::apps
