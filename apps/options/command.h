// The command line as the subcommands see it: options, flags and what is checked of them. CLI11 stands behind
// it, and is compiled in command.cpp alone.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class Option;
}  // namespace CLI

namespace vegard::apps {

/// A command that finds no memory for its work: what was done, and how to need less.
class OutOfMemory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An option of a subcommand, by reference: copies are the same option. It lives as long as its Program. All
/// that sets something gives the option again.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  const Option& required() const;
  /// How the help calls its value: "OUT.exr".
  const Option& type_name(const std::string& name) const;
  /// Words in the help in place of those given first.
  const Option& description(const std::string& words = {}) const;
  /// The value that it has now stands in the help as its default.
  const Option& shows_default() const;

  /// Both ends included.
  const Option& range(int low, int high) const;
  const Option& range(std::uint64_t low, std::uint64_t high) const;
  /// Both ends included. It lets "nan" through, which is neither below nor above anything: see
  /// finite_range().
  const Option& range(double low, double high) const;
  /// The same, and refuses what is no number.
  const Option& finite_range(double low, double high) const;
  const Option& one_of(std::initializer_list<const char*> words) const;
  const Option& one_of(std::initializer_list<int> numbers) const;
  /// `complaint` says what is wrong with a word, nothing if it is good; `type` is what the help calls such
  /// words.
  const Option& check(const std::function<std::string(const std::string& word)>& complaint,
                      const std::string& type) const;

  /// Splits a word into several values.
  const Option& delimiter(char separator) const;
  /// How many values it takes; below 0: at least so many.
  const Option& expected(int count) const;
  const Option& expected(int least, int most) const;
  /// One value (or one word with delimiters) an occurrence: else it would swallow words that follow it.
  const Option& one_an_occurrence() const;
  /// One value an occurrence, and every occurrence counts.
  const Option& repeated() const;

  const Option& excludes(const Option& other) const;
  const Option& needs(const Option& other) const;
  const Option& needs(const std::string& other) const;

  /// Known once the command line is read.
  bool given() const;
  /// As messages call it: "--voxel".
  std::string name() const;

  bool operator==(const Option& other) const { return option_ == other.option_; }

 private:
  CLI::Option* option_;
};

/// A subcommand, by reference, as Option. What options write to must outlive the parsing.
class Command {
 public:
  Command(CLI::App* app, int* exit_code) : app_(app), exit_code_(exit_code) {}

  /// `names`: "-o,--output", or "SCENE" for a word by its place.
  Option option(const std::string& names, std::string& value, const std::string& words = {}) const;
  Option option(const std::string& names, int& value, const std::string& words = {}) const;
  Option option(const std::string& names, std::uint64_t& value, const std::string& words = {}) const;
  Option option(const std::string& names, double& value, const std::string& words = {}) const;
  Option option(const std::string& names, std::optional<int>& value, const std::string& words = {}) const;
  Option option(const std::string& names, std::optional<std::uint64_t>& value,
                const std::string& words = {}) const;
  Option option(const std::string& names, std::optional<double>& value, const std::string& words = {}) const;
  Option option(const std::string& names, std::vector<std::string>& values,
                const std::string& words = {}) const;
  Option option(const std::string& names, std::vector<int>& values, const std::string& words = {}) const;
  Option option(const std::string& names, std::vector<double>& values, const std::string& words = {}) const;
  /// A list for each occurrence.
  Option option(const std::string& names, std::vector<std::vector<std::string>>& values,
                const std::string& words = {}) const;
  Option flag(const std::string& names, bool& value, const std::string& words = {}) const;

  /// A subcommand of this one, which is nothing without one then.
  Command add(const std::string& name, const std::string& description) const;

  /// One that was added before.
  Option option_of_name(const std::string& name) const;

  /// Once the command line is read: the options in the order in which it gave them, one as often as it was
  /// given.
  std::vector<Option> order() const;

  /// `call` does the work and gives the program's exit code. Where it finds no memory, in whatever thread,
  /// OutOfMemory is thrown.
  void runs(std::function<int()> call) const;

 private:
  CLI::App* app_;
  int* exit_code_;
};

/// An option in words, for manuals.
struct OptionText {
  std::vector<std::string> names;    ///< "-o", "--output"; of a word by its place its name alone, "SCENE"
  std::string value;                 ///< what the help calls its value; empty: a flag
  std::vector<std::string> choices;  ///< the words that it takes, if they are few
  std::string words;
  bool by_place = false, required = false;
};

/// A subcommand, or the whole program, in words.
struct CommandText {
  std::string name;  ///< "survey run"; of the program its own
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

  /// A subcommand.
  Command add(const std::string& name, const std::string& description);

  /// What is given without a subcommand.
  Command root();

  /// All of it in words, as far as it has been added.
  CommandText text() const;

  /// Words that nothing takes are no error.
  void takes_more();

  /// The program's name without its folder and the arguments as given, quoted where a shell would need it:
  /// for a result's provenance.
  std::string command_line() const;

  /// Parses, and calls the subcommand if there is one. The exit code if this was the end: --help, --version,
  /// or wrong words, which are reported on standard error. Throws what the subcommand throws.
  std::optional<int> read();

  /// read() of a program that is nothing without a subcommand; gives the exit code.
  int run();

 private:
  std::unique_ptr<CLI::App> app_;
  int argc_;
  const char* const* argv_;
  int exit_code_ = 0;
};

}  // namespace vegard::apps
