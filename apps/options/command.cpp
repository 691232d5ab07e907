#include "apps/options/command.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>

#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/standard_streams.h"
#include "sim/base/shown_text.h"
#include "sim/base/text.h"
#include "sim/scene/rows/complaint.h"

namespace vegard::apps {
namespace {

int tell_bad_usage(const std::string& program, const std::string& message, const std::string& meant = {}) {
  complain(program, sim::shortened_quotes(message) +
                        (meant.empty() ? "" : "; did you mean '" + meant + "'?") + " (see " + program +
                        " --help)");
  return bad_usage;
}

std::string near_name(std::string_view name, const std::vector<std::string>& known) {
  const std::string nearest = sim::nearest_name(name, known);
  return sim::is_near(name, nearest) ? nearest : std::string();
}

/// The subcommand or option that the first unknown word may have been meant as; empty if it is like none.
/// `first`: where the words of `app` begin.
std::string meant_by(const CLI::App& app, int argc, const char* const* argv, int first = 1) {
  if (argc <= first) return {};
  std::vector<std::string> known;
  const CLI::App* subcommand = nullptr;
  for (const CLI::App* one : app.get_subcommands({})) {
    known.push_back(one->get_name());
    if (known.back() == argv[first]) subcommand = one;
  }
  if (subcommand == nullptr) return argv[first][0] == '-' ? "" : near_name(argv[first], known);
  ++first;
  if (!subcommand->get_subcommands({}).empty()) return meant_by(*subcommand, argc, argv, first);
  known.clear();
  for (const CLI::Option* option : subcommand->get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = first; i < argc; ++i) {
    const std::string_view word = argv[i];
    const std::string name(word.substr(0, word.find('=')));
    if (name.rfind("--", 0) != 0 || std::find(known.begin(), known.end(), name) != known.end()) continue;
    return near_name(name, known);
  }
  return {};
}

/// "survey run": without the program's own name.
std::string full_name(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  if (parent == nullptr || parent->get_parent() == nullptr) return app.get_name();
  return full_name(*parent) + " " + app.get_name();
}

/// What an option takes, from CLI11's description of it: of "INT:INT in [0 - 1024]" the name NUMBER and the
/// limits "0 to 1024", of "TEXT:{good,bad}" the name WORD and two choices, of "TEXT:SIZE" the name SIZE.
struct ValueText {
  std::string name, limits;
  std::vector<std::string> choices;
};

ValueText value_text(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  // A name of ours may have colons of its own ("FIRST:LAST"); the library adds what a value must be.
  std::size_t end = type.find(':');
  if (type.rfind("INT", 0) != 0 && type.rfind("UINT", 0) != 0 && type.rfind("FLOAT", 0) != 0 &&
      type.rfind("TEXT", 0) != 0)
    end = std::min(
        {type.find(":INT in ["), type.find(":UINT in ["), type.find(":FLOAT in ["), type.find(":{")});
  ValueText value;
  value.name = type.substr(0, end);
  if (value.name == "INT" || value.name == "UINT" || value.name == "FLOAT") value.name = "NUMBER";
  std::istringstream parts(end == std::string::npos ? std::string() : type.substr(end + 1));
  for (std::string part; std::getline(parts, part, ':');) {
    if (part.empty()) continue;
    const std::size_t open = part.find(" in ["), dash = part.rfind(" - ");
    if (part.front() == '{') {
      std::istringstream words(part.substr(1, part.size() - 2));
      for (std::string word; std::getline(words, word, ',');) value.choices.push_back(word);
    } else if (open != std::string::npos && dash != std::string::npos) {
      value.limits =
          part.substr(open + 5, dash - open - 5) + " to " + part.substr(dash + 3, part.size() - dash - 4);
    } else if (value.name == "TEXT") {
      value.name = part;
    }
  }
  if (value.name == "TEXT" && !value.choices.empty()) value.name = "WORD";
  return value;
}

bool takes_value(const CLI::Option& option) {
  return option.get_positional() || option.get_items_expected_max() > 0;
}

/// "--csv or --sources", in the order of names.
std::string names_of(const std::set<CLI::Option*>& options) {
  std::set<std::string> names;
  for (const CLI::Option* option : options) names.insert(option->get_name());
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : " or ") + name.substr(name.rfind(',') + 1);
  return text;
}

/// The words of an option with what it takes, its default, and the options that it needs or excludes.
std::string described(const CLI::Option& option) {
  std::vector<std::string> facts;
  if (takes_value(option)) {
    const ValueText value = value_text(option);
    if (!value.choices.empty()) facts.push_back(sim::joined(value.choices));
    if (!value.limits.empty()) facts.push_back(value.limits);
  }
  const std::string& words = option.get_description();
  if (!option.get_default_str().empty()) facts.push_back("default: " + option.get_default_str());
  if (!option.get_needs().empty() && words.find("needs ") == std::string::npos)
    facts.push_back("needs " + names_of(option.get_needs()));
  if (!option.get_excludes().empty()) facts.push_back("not with " + names_of(option.get_excludes()));
  if (facts.empty()) return words;
  // What already ends with facts in parentheses gets the others there.
  const std::size_t last = words.rfind("(default");
  const bool has_facts = last != std::string::npos && words.find(')', last) + 1 == words.size();
  return (has_facts ? words.substr(0, words.size() - 1) + "; " : words + " (") + sim::joined(facts, "; ") +
         ")";
}

/// --help with the same words as the manual.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    std::string name = CLI::Formatter::make_option_name(option, is_positional);
    if (const std::size_t mark = name.find("{false}"); mark != std::string::npos) name.erase(mark, 7);
    return name;
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    if (!takes_value(*option) || option->get_positional()) return {};
    return " " + value_text(*option).name +
           (option->get_expected_max() == CLI::detail::expected_max_vector_size ? " ..." : "");
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return described(*option) + (option->get_required() ? " (required)" : "");
  }
};

CommandText text_of(const CLI::App& app) {
  CommandText text;
  text.name = full_name(app);
  text.words = app.get_description();
  for (const CLI::Option* option : app.get_options()) {
    OptionText one;
    one.by_place = option->get_positional();
    if (one.by_place) one.names.push_back(option->get_name(true));
    for (const std::string& name : option->get_snames()) one.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) one.names.push_back("--" + name);
    if (takes_value(*option)) {
      const ValueText value = value_text(*option);
      one.value = value.name;
      one.choices = value.choices;
    }
    one.words = described(*option);
    one.required = option->get_required();
    text.options.push_back(one);
  }
  for (const CLI::App* subcommand : app.get_subcommands({})) {
    text.subcommands.push_back(text_of(*subcommand));
    text.subcommands.back().group = subcommand->get_group();
  }
  return text;
}

/// Its help ends with the exit codes. One subcommand is enough: words that follow it are its own, even those
/// that name another ("vegard manual render", a run's directory called "map").
CLI::App* prepared(CLI::App* app) { return app->footer(exit_code_help())->require_subcommand(0, 1); }

OutOfMemory out_of_memory(const std::string& command) {
  const auto is_one_of = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), command) != names.end();
  };
  const std::string advice =
      is_one_of({"render", "animate", "brightness", "preview", "directions"})
          ? "a smaller camera.width and camera.height, or fewer --threads, need less"
      : is_one_of({"fit", "sequence"})
          ? "a part of the picture (fit.roi_px), a smaller picture, or fewer --threads need less"
      : is_one_of({"volume", "slices"}) ? "larger voxels, a --box, or --of NAME need less"
      : is_one_of({"grid"})             ? "a single --channel, or a grid of larger voxels, needs less"
      : is_one_of({"points"})           ? "--max-points needs less"
                                        : "a smaller picture needs less";
  return OutOfMemory("vegard " + command + " found no more memory for its work; " + advice);
}

}  // namespace

const Option& Option::required() const {
  option_->required();
  return *this;
}

const Option& Option::type_name(const std::string& name) const {
  option_->type_name(name);
  return *this;
}

const Option& Option::description(const std::string& words) const {
  option_->description(words);
  return *this;
}

const Option& Option::shows_default() const {
  option_->capture_default_str();
  return *this;
}

const Option& Option::range(int low, int high) const {
  option_->check(CLI::Range(low, high));
  return *this;
}

const Option& Option::range(std::uint64_t low, std::uint64_t high) const {
  option_->check(CLI::Range(low, high));
  return *this;
}

const Option& Option::range(double low, double high) const {
  option_->check(CLI::Range(low, high));
  return *this;
}

const Option& Option::finite_range(double low, double high) const {
  const CLI::Range range(low, high);
  option_->check(CLI::Validator(
      [range](std::string& word) {
        double number = 0.0;
        if (CLI::detail::lexical_cast(word, number) && std::isnan(number))
          return "'" + word + "' is no number";
        return range(word);
      },
      range.get_description()));
  return *this;
}

const Option& Option::one_of(std::initializer_list<const char*> words) const {
  option_->check(CLI::IsMember(std::vector<std::string>(words.begin(), words.end())));
  return *this;
}

const Option& Option::one_of(std::initializer_list<int> numbers) const {
  option_->check(CLI::IsMember(numbers));
  return *this;
}

const Option& Option::check(const std::function<std::string(const std::string& word)>& complaint,
                            const std::string& type) const {
  option_->check(CLI::Validator([complaint](std::string& word) { return complaint(word); }, type));
  return *this;
}

const Option& Option::delimiter(char separator) const {
  option_->delimiter(separator);
  return *this;
}

const Option& Option::expected(int count) const {
  option_->expected(count);
  return *this;
}

const Option& Option::expected(int least, int most) const {
  option_->expected(least, most);
  return *this;
}

const Option& Option::one_an_occurrence() const {
  option_->allow_extra_args(false);
  return *this;
}

const Option& Option::repeated() const {
  option_->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

const Option& Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}

const Option& Option::needs(const Option& other) const {
  option_->needs(other.option_);
  return *this;
}

const Option& Option::needs(const std::string& other) const {
  option_->needs(other);
  return *this;
}

bool Option::given() const { return option_->count() > 0; }

std::string Option::name() const { return option_->get_name(); }

template <class Value>
Option Command::option(const std::string& names, Value& value, const std::string& words) const {
  return Option(app_->add_option(names, value, words));
}
template Option Command::option(const std::string&, std::string&, const std::string&) const;
template Option Command::option(const std::string&, int&, const std::string&) const;
template Option Command::option(const std::string&, std::uint64_t&, const std::string&) const;
template Option Command::option(const std::string&, double&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<int>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::uint64_t>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<double>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<int>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<double>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<std::vector<std::string>>&,
                                const std::string&) const;

Option Command::flag(const std::string& names, bool& value, const std::string& words) const {
  return Option(app_->add_flag(names, value, words));
}

Command Command::add(const std::string& name, const std::string& description) const {
  // A subcommand would take over the group that its command has in the program.
  return Command(prepared(app_->add_subcommand(name, description)->group("Subcommands")), exit_code_);
}

Option Command::option_of_name(const std::string& name) const { return Option(app_->get_option(name)); }

std::vector<Option> Command::order() const {
  std::vector<Option> options;
  for (CLI::Option* given : app_->parse_order()) options.emplace_back(given);
  return options;
}

void Command::runs(std::function<int()> call) const {
  app_->add_flag_function(
      "-q,--quiet", [](std::int64_t) { voice().is_quiet = true; },
      "No progress, notes or summary: only what is asked for, warnings and errors");
  if (app_->get_option_no_throw("--json") == nullptr)
    app_->add_flag_function(
        "--json", [](std::int64_t) { voice().is_json = true; }, "Print one JSON object in place of text");
  app_->callback([call = std::move(call), code = exit_code_, name = full_name(*app_)] {
    try {
      *code = call();
      if (voice().is_json) say_json(json_answer_text());
    } catch (const std::bad_alloc&) {
      throw out_of_memory(name);
    } catch (const std::length_error&) {  // more than any memory could hold
      throw out_of_memory(name);
    }
  });
}

Option add_threads_option(const Command& command, int& threads) {
  return command.option("--threads", threads, "Threads to use (0: all cores); the result is the same")
      .range(0, 1024);
}

Program::Program(const std::string& name, const std::string& description,
                 const std::function<std::string()>& versions, int argc, const char* const* argv)
    : app_(std::make_unique<CLI::App>(description, name)), argc_(argc), argv_(argv) {
  app_->formatter(std::make_shared<HelpFormatter>());  // subcommands take it over
  prepared(app_.get());
  if (versions)
    app_->set_version_flag("--version", versions, "Print the versions of vegard and of its libraries");
}

Program::~Program() = default;

void Program::begin_group(const std::string& title) { group_ = title; }

Command Program::add(const std::string& name, const std::string& description) {
  CLI::App* subcommand = prepared(app_->add_subcommand(name, description));
  if (!group_.empty()) subcommand->group(group_);
  return Command(subcommand, &exit_code_);
}

std::string Program::command_line() const {
  std::string text;
  for (int i = 0; i < argc_; ++i) {
    std::string_view word = argv_[i];
    if (i == 0) word = word.substr(word.rfind('/') + 1);
    text += (i > 0 ? " " : "") + sim::quoted_for_shell(word);
  }
  return text;
}

CommandText Program::text() const { return text_of(*app_); }

Command Program::root() { return Command(app_.get(), &exit_code_); }

void Program::takes_more() { app_->allow_extras(); }

std::optional<int> Program::read() {
  try {
    app_->parse(argc_, argv_);
  } catch (const CLI::ParseError& error) {
    // Help and version come this way too, as good ends.
    if (error.get_exit_code() == 0) {
      std::ostringstream words;
      app_->exit(error, words, words);
      say_result(words.str());
      return good;
    }
    return tell_bad_usage(app_->get_name(), error.what(), meant_by(*app_, argc_, argv_));
  }
  return std::nullopt;
}

int Program::run() {
  if (const std::optional<int> end = read()) return *end;
  // CLI11's own require_subcommand would hide a misspelt subcommand behind "a subcommand is required".
  std::string called = app_->get_name();
  for (const CLI::App* app = app_.get(); !app->get_subcommands({}).empty();) {
    if (app->get_subcommands().empty()) return tell_bad_usage(called, "which subcommand?");
    app = app->get_subcommands().front();
    called += " " + app->get_name();
  }
  return exit_code_;
}

}  // namespace vegard::apps
