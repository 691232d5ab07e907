#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
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
  std::vector<std::unique_ptr<sim::WholeFile>> files;
  try {
    for (const auto& [name, text] : texts) {
      const std::filesystem::path path = std::filesystem::path(request.folder) / name;
      make_folder(path.parent_path(), folders);
      files.push_back(std::make_unique<sim::WholeFile>(path.string(), request.overwrite));
      files.back()->write(text);
    }
    for (const std::unique_ptr<sim::WholeFile>& file : files) file->commit();
    for (const auto& [name, text] : texts)
      json_answer()["outputs"].push_back((std::filesystem::path(request.folder) / name).string());
  } catch (...) {
    files.clear();
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
