#include "apps/output/manual.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
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

std::string in_quotes(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
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

}  // namespace

std::string page_name(const CommandText& program, const CommandText& command) {
  if (&program == &command) return program.name;
  std::string name = program.name + "-" + command.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

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

std::string bash_completion(const CommandText& program) {
  std::string cases;
  const auto add = [&](const CommandText& command, const std::string& path) {
    cases += fmt::format("    {}) words={} ;;\n", in_quotes(path),
                         in_quotes(sim::joined(names_of_subcommands(command), " ") + " " +
                                   sim::joined(option_names(command), " ")));
  };
  add(program, "");
  std::string values;
  each_command(program, [&](const CommandText& command) {
    add(command, command.name);
    for (const OptionText& option : command.options)
      if (!option.choices.empty())
        for (const std::string& name : option.names)
          values += fmt::format("    {}) words={} ;;\n", in_quotes(command.name + " " + name),
                                in_quotes(sim::joined(option.choices, " ")));
  });
  std::string all;
  each_command(program, [&](const CommandText& command) { all += " " + in_quotes(command.name); });
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
                        in_quotes(sub.name), in_quotes(short_words(sub.words)));
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
      text += fmt::format("complete -c {} -n {} -a {}\n", program.name, in_quotes(when), in_quotes(name));
    for (const OptionText& option : command.options) {
      if (option.by_place) continue;
      text += fmt::format("complete -c {} -n {}", program.name, in_quotes(when));
      for (const std::string& name : option.names)
        text += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.value.empty()) text += " -r";
      if (!option.choices.empty()) text += " -f -a " + in_quotes(sim::joined(option.choices, " "));
      text += " -d " + in_quotes(short_words(option.words)) + "\n";
    }
  });
  return text;
}

}  // namespace vegard::apps
