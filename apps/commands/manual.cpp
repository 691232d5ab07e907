#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/manual.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

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

int run_manual(const ManualRequest& request, const CommandText& program) {
  if (!request.folder.empty()) {
    for (const auto& [name, text] : all_files(program)) {
      const std::filesystem::path path = std::filesystem::path(request.folder) / name;
      std::error_code error;
      std::filesystem::create_directories(path.parent_path(), error);  // else writing tells
      sim::WholeFile file(path.string(), request.overwrite);
      file.write(text);
      file.commit();
    }
    return good;
  }
  if (!request.shell.empty()) {
    say_text(completion(program, request.shell));
    return good;
  }
  const CommandText* command = request.command.empty() ? &program : find(program, request.command);
  if (command == nullptr)
    throw usage_error("COMMAND", "there is no subcommand '" + request.command + "'",
                      "one of vegard --help; of two words in quotes, \"survey run\"");
  say_text(man_page(program, *command));
  return good;
}

}  // namespace

void add_manual_command(Program& program) {
  const auto options = std::make_shared<ManualRequest>();
  const Command command = program.add("manual", "Print a manual page, or what a shell completes commands by");
  const Option page =
      command.option("COMMAND", options->command, "The subcommand whose page is wanted; none: the program's");
  const Option shell =
      command.option("--completion", options->shell, "Print the completion of a shell instead")
          .one_of({"bash", "zsh", "fish"})
          .excludes(page);
  command.option("-o,--output", options->folder, "Write all pages and completions, as below a share/ folder")
      .type_name("FOLDER")
      .excludes(page)
      .excludes(shell);
  command.flag("--overwrite", options->overwrite, "Replace files that exist");
  command.runs([options, &program] { return run_manual(*options, program.text()); });
}

}  // namespace vegard::apps
