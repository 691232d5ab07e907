#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/options/command.h"
#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/shown_text.h"
#include "sim/base/text.h"
#include "sim/base/version.h"

namespace vegard::apps {
namespace {

/// In man's macros: no character of a text is one of theirs.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '\n')
      out += ' ';
    else
      out += c;
  }
  if (!out.empty() && (out[0] == '.' || out[0] == '\'')) out.insert(0, "\\&");
  return out;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

/// "\fB\-o\fR, \fB\-\-output\fR \fIOUT.exr\fR"
std::string heading(const OptionText& option) {
  std::string text;
  for (const std::string& name : option.names)
    text += (text.empty() ? "" : ", ") + ("\\fB" + escaped(name) + "\\fR");
  if (!option.value.empty() && !option.by_place) text += " \\fI" + escaped(option.value) + "\\fR";
  return text;
}

std::string options_section(const char* title, const CommandText& command, bool by_place) {
  std::string text;
  for (const OptionText& option : command.options) {
    if (option.by_place != by_place) continue;
    text += ".TP\n" + heading(option) + "\n" + escaped(option.words) +
            (option.required ? " (required)" : "") + "\n";
  }
  return text.empty() ? text : std::string(".SH ") + title + "\n" + text;
}

/// Of all commands that have options, depth first: the program itself without any of them.
template <class Call>
void each_command(const CommandText& command, const Call& call) {
  for (const CommandText& sub : command.subcommands) {
    call(sub);
    each_command(sub, call);
  }
}

std::vector<std::string> names_of_subcommands(const CommandText& command) {
  std::vector<std::string> names;
  for (const CommandText& sub : command.subcommands)
    names.push_back(sub.name.substr(sub.name.rfind(' ') + 1));
  return names;
}

std::vector<std::string> option_names(const CommandText& command) {
  std::vector<std::string> names;
  for (const OptionText& option : command.options)
    if (!option.by_place) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

/// The first line of a text, for a list of commands or options.
std::string short_words(const std::string& words) { return words.substr(0, words.find_first_of(";\n")); }

/// "vegard-survey-run" for the subcommand "survey run", "vegard" for the program itself.
std::string page_name(const CommandText& program, const CommandText& command) {
  if (&program == &command) return program.name;
  std::string name = program.name + "-" + command.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

/// The manual page of a command or of the program itself, in man macros (section 1).
std::string man_page(const CommandText& program, const CommandText& command) {
  const bool whole = &program == &command;
  const std::string name = page_name(program, command),
                    called = whole ? name : program.name + " " + command.name;
  std::string text =
      fmt::format(".TH {} 1 \"\" \"vegard {}\" \"User Commands\"\n", escaped(upper(name)), sim::version());
  text += fmt::format(".SH NAME\n{} \\- {}\n", escaped(name), escaped(command.words));
  text += ".SH SYNOPSIS\n.B " + escaped(called) + "\n";
  for (const OptionText& option : command.options)
    if (option.by_place)
      text += (option.required ? "\\fI" : "[\\fI") + escaped(option.names.front()) +
              (option.required ? "\\fR\n" : "\\fR]\n");
  text += command.subcommands.empty() ? "[\\fIOPTIONS\\fR]\n" : "\\fISUBCOMMAND\\fR ...\n";
  if (!command.subcommands.empty()) {
    text += ".SH SUBCOMMANDS\n";
    std::string group = command.subcommands.front().group;
    if (whole) text += ".SS " + escaped(group) + "\n";
    for (const CommandText& sub : command.subcommands) {
      if (whole && sub.group != group) text += ".SS " + escaped(group = sub.group) + "\n";
      text += fmt::format(".TP\n\\fB{}\\fR(1)\n{}\n", escaped(page_name(program, sub)), escaped(sub.words));
    }
  }
  text += options_section("ARGUMENTS", command, true) + options_section("OPTIONS", command, false);
  text += ".SH EXIT STATUS\n";
  for (const ExitMeaning& exit : exit_meanings())
    text += fmt::format(".TP\n.B {}\n{}\n", static_cast<int>(exit.code), escaped(exit.words));
  if (!whole) text += ".SH SEE ALSO\n.BR " + escaped(program.name) + " (1)\n";
  return text;
}

/// Completions of `vegard` for bash, zsh or fish: subcommands, options and their allowed values; file names
/// for everything else.
std::string bash_completion(const CommandText& program) {
  std::string cases;
  const auto add = [&](const CommandText& command, const std::string& path) {
    cases += fmt::format("    {}) words={} ;;\n", sim::in_shell_quotes(path),
                         sim::in_shell_quotes(sim::joined(names_of_subcommands(command), " ") + " " +
                                         sim::joined(option_names(command), " ")));
  };
  add(program, "");
  std::string values;
  each_command(program, [&](const CommandText& command) {
    add(command, command.name);
    for (const OptionText& option : command.options)
      if (!option.choices.empty())
        for (const std::string& name : option.names)
          values += fmt::format("    {}) words={} ;;\n", sim::in_shell_quotes(command.name + " " + name),
                                sim::in_shell_quotes(sim::joined(option.choices, " ")));
  });
  std::string all;
  each_command(program, [&](const CommandText& command) { all += " " + sim::in_shell_quotes(command.name); });
  return fmt::format(R"(# Completion of {0} in bash, made by `{0} manual`.
_{0}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} command= next words= known i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    next=${{command:+$command }}${{COMP_WORDS[i]}}
    for known in{1}; do
      if [[ $known == "$next" ]]; then command=$next; continue 2; fi
    done
    break
  done
  case "$command $before" in
{2}    *) ;;
  esac
  if [[ -z $words ]]; then
    case $command in
{3}      *) ;;
    esac
    # What begins with no dash is a subcommand, or a file.
    if [[ $word != -* ]]; then words=" $words" && words=${{words%% -*}}; fi
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}}
complete -o default -F _{0} {0}
)",
                     program.name, all, values, cases);
}

std::string zsh_completion(const CommandText& program) {
  // zsh takes bash's completions as they are.
  return fmt::format(
      "#compdef {0}\n# Completion of {0} in zsh, made by `{0} manual`.\nautoload -U +X "
      "bashcompinit && bashcompinit\n{1}",
      program.name, bash_completion(program));
}

std::string fish_completion(const CommandText& program) {
  std::string text = fmt::format("# Completion of {0} in fish, made by `{0} manual`.\n", program.name);
  for (const CommandText& sub : program.subcommands)
    text += fmt::format("complete -c {} -n __fish_use_subcommand -a {} -d {}\n", program.name,
                        sim::in_shell_quotes(sub.name), sim::in_shell_quotes(short_words(sub.words)));
  each_command(program, [&](const CommandText& command) {
    // Of "survey run" both words have to have been given.
    std::string when;
    std::string_view rest = command.name;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      when += (when.empty() ? "" : "; and ") +
              ("__fish_seen_subcommand_from " + std::string(rest.substr(0, end)));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    for (const std::string& name : names_of_subcommands(command))
      text += fmt::format("complete -c {} -n {} -a {}\n", program.name, sim::in_shell_quotes(when),
                          sim::in_shell_quotes(name));
    for (const OptionText& option : command.options) {
      if (option.by_place) continue;
      text += fmt::format("complete -c {} -n {}", program.name, sim::in_shell_quotes(when));
      for (const std::string& name : option.names)
        text += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.value.empty()) text += " -r";
      if (!option.choices.empty()) text += " -f -a " + sim::in_shell_quotes(sim::joined(option.choices, " "));
      text += " -d " + sim::in_shell_quotes(short_words(option.words)) + "\n";
    }
  });
  return text;
}

struct ManualRequest {
  std::string command, shell, folder;
  bool overwrite = false;
};

/// The command of a name such as "survey run"; null: there is none.
const CommandText* find(const CommandText& among, const std::string& name) {
  if (among.name == name) return &among;
  for (const CommandText& sub : among.subcommands)
    if (const CommandText* found = find(sub, name)) return found;
  return nullptr;
}

std::string completion(const CommandText& program, const std::string& shell) {
  return shell == "bash"  ? bash_completion(program)
         : shell == "zsh" ? zsh_completion(program)
                          : fish_completion(program);
}

/// Every file by its name below a share/ folder.
std::map<std::string, std::string> all_files(const CommandText& program) {
  std::map<std::string, std::string> files;
  const std::function<void(const CommandText&)> add = [&](const CommandText& command) {
    files["man/man1/" + page_name(program, command) + ".1"] = man_page(program, command);
    for (const CommandText& sub : command.subcommands) add(sub);
  };
  add(program);
  files["bash-completion/completions/" + program.name] = bash_completion(program);
  files["zsh/vendor-completions/_" + program.name] = zsh_completion(program);
  files["fish/vendor_completions.d/" + program.name + ".fish"] = fish_completion(program);
  return files;
}

/// Makes a folder with those above it; the ones that were missing are added to `made`, the outermost first.
void make_folder(const std::filesystem::path& folder, std::vector<std::filesystem::path>& made) {
  std::error_code error;
  if (folder.empty() || std::filesystem::exists(folder, error)) return;
  make_folder(folder.parent_path(), made);
  if (std::filesystem::create_directory(folder, error)) made.push_back(folder);  // else writing fails
}

/// All of them or none: no file gets its name before every one is written.
void write_files(const std::map<std::string, std::string>& texts, const ManualRequest& request) {
  std::vector<std::filesystem::path> folders;
  std::optional<sim::WholeFiles> files(request.overwrite);
  try {
    for (const auto& [name, text] : texts) {
      const std::filesystem::path path = std::filesystem::path(request.folder) / name;
      make_folder(path.parent_path(), folders);
      files->claim(path.string());
      files->write(path.string(), text);
    }
    files->commit();
    json_answer()["outputs"] = json_names(files->written());
  } catch (...) {
    files.reset();
    std::error_code error;  // what is not empty stays
    for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder)
      std::filesystem::remove(*folder, error);
    throw;
  }
}

Json command_json(const CommandText& command) {
  Json json = {{"name", command.name},
               {"words", command.words},
               {"options", Json::array()},
               {"subcommands", Json::array()}};
  for (const OptionText& option : command.options)
    json["options"].push_back({{"names", option.names},
                               {"value", option.value},
                               {"choices", option.choices},
                               {"words", option.words},
                               {"by_place", option.by_place},
                               {"required", option.required}});
  for (const CommandText& sub : command.subcommands) json["subcommands"].push_back(command_json(sub));
  return json;
}

int run_manual(const ManualRequest& request, const CommandText& program) {
  if (!request.folder.empty()) {
    write_files(all_files(program), request);
    return good;
  }
  if (!request.shell.empty()) {
    json_answer() = {{"shell", request.shell}, {"completion", completion(program, request.shell)}};
    say_result(completion(program, request.shell));
    return good;
  }
  const CommandText* command = request.command.empty() ? &program : find(program, request.command);
  if (command == nullptr)
    throw usage_error("COMMAND", "there is no subcommand '" + request.command + "'",
                      "one of vegard --help; of two words in quotes, \"survey run\"");
  json_answer() = command_json(*command);
  json_answer()["exit_codes"] = Json::array();
  for (const ExitMeaning& exit : exit_meanings())
    json_answer()["exit_codes"].push_back({{"code", static_cast<int>(exit.code)}, {"meaning", exit.words}});
  say_result(man_page(program, *command));
  return good;
}

}  // namespace

void add_manual_command(Program& program) {
  const auto options = std::make_shared<ManualRequest>();
  const Command command = program.add("manual", "Print a manual page, or the completions of a shell");
  const Option page = command.option("COMMAND", options->command, "The subcommand (default: the program)");
  const Option shell =
      command.option("--completion", options->shell, "Print the completion of a shell instead")
          .one_of({"bash", "zsh", "fish"})
          .excludes(page);
  command
      .option("-o,--output", options->folder,
              "Write all pages and completions, laid out like a share/ folder")
      .type_name("FOLDER")
      .excludes(page)
      .excludes(shell);
  command.flag("--overwrite", options->overwrite, "Replace files that exist");
  command.runs([options, &program] { return run_manual(*options, program.text()); });
}

}  // namespace vegard::apps
