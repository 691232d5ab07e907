#include <csignal>
#include <exception>
#include <new>
#include <string>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "fit/survey/sqlite_file.h"
#include "fit/version.h"
#include "sim/base/error.h"
#include "sim/base/grid/vdb_io.h"
#include "sim/base/module.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/processor.h"
#include "sim/base/version.h"

namespace {

using namespace vegard;

std::string versions() {
  return "vegard " + sim::version() + "\nCeres " + fit::ceres_version() + "\nOpenCV " +
         fit::opencv_version() + "\nEigen " + sim::eigen_version() + "\nOpenImageIO " +
         sim::image_library_version() + "\nCFITSIO " + sim::fits_library_version() + "\nOpenVDB " +
         sim::vdb_library_version() + "\nSQLite " + fit::sqlite_version();
}

int report(const std::string& message, int exit_code) {
  apps::complain("vegard", message);
  return exit_code;
}

int run(int argc, char** argv) {
  apps::Program program("vegard", "Simulates aurorae and fits them to photographs.", versions, argc, argv);
  for (const apps::CommandGroup& group : apps::command_groups()) {
    program.begin_group(group.title);
    for (apps::AddCommand* const add : group.commands) add(program);
  }
  const int exit_code = program.run();
  return exit_code == apps::interrupted ? apps::exit_code_of_interruption() : exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // A write past the file size limit is to fail as on a full disk, not to kill the process.
  std::signal(SIGXFSZ, SIG_IGN);
  apps::replace_closed_streams();
  try {
    sim::check_processor();
    const int exit_code = run(argc, argv);
    apps::finish_output();
    return exit_code;
  } catch (const sim::Error& error) {
    return report(error.what(), apps::exit_code_of(error.kind()));
  } catch (const sim::MissingModule& error) {
    return report(error.what(), apps::internal_error);
  } catch (const apps::OutOfMemory& error) {
    return report(error.what(), apps::internal_error);
  } catch (const std::bad_alloc&) {
    return report("there is not enough memory to begin", apps::internal_error);
  } catch (const std::exception& error) {
    return report(std::string("internal error: ") + error.what(), apps::internal_error);
  }
}
