#include "fit/survey/sqlite_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include <sqlite3.h>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"

namespace vegard::fit {
namespace {

constexpr int kWait_ms = 60000;
constexpr int kMaxCellBytes = 16 << 20;

/// Returns a name that SQLite takes for a file's whatever it looks like: ":memory:" and "file:…" mean
/// something else to it.
std::string absolute_name(const std::string& file) {
  std::error_code ignored;
  return std::filesystem::absolute(file, ignored).string();
}

/// Whether the file's system refuses every lock. SQLite takes that for a lock that another process holds.
bool has_no_locks(const std::string& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock lock = {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = 0;
  lock.l_len = 1;  // SQLite's own locks lie a gigabyte behind
  const bool is_refused = ::fcntl(descriptor, F_SETLK, &lock) != 0;
  const int why = errno;
  ::close(descriptor);
  return is_refused && (why == ENOLCK || why == ENOSYS || why == EOPNOTSUPP || why == EINVAL);
}

}  // namespace

SqliteStatement::SqliteStatement(const SqliteFile& file, const std::string& sql) : file_(file) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(file.database_.get(), sql.c_str(), static_cast<int>(sql.size()) + 1,
                                      &statement, nullptr);
  statement_.reset(statement);
  if (code != SQLITE_OK) throw error_of(code);
}

void SqliteStatement::Finalizer::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

sim::Error SqliteStatement::error_of(int code) const {
  return file_.error_of(code, sqlite3_errmsg(file_.database_.get()));
}

void SqliteStatement::require(bool is_sound) const {
  if (!is_sound) throw file_.error_of(SQLITE_CORRUPT, "a value is of another type than its column");
}

SqliteStatement& SqliteStatement::bind(int place, const std::string& text) {
  const int code = sqlite3_bind_text(statement_.get(), place + 1, text.data(), static_cast<int>(text.size()),
                                     SQLITE_TRANSIENT);
  if (code != SQLITE_OK) throw error_of(code);
  return *this;
}

SqliteStatement& SqliteStatement::bind(int place, std::int64_t number) {
  if (const int code = sqlite3_bind_int64(statement_.get(), place + 1, number); code != SQLITE_OK)
    throw error_of(code);
  return *this;
}

SqliteStatement& SqliteStatement::bind(int place, double number) {
  if (const int code = sqlite3_bind_double(statement_.get(), place + 1, number); code != SQLITE_OK)
    throw error_of(code);
  return *this;
}

SqliteStatement& SqliteStatement::bind_null(int place) {
  if (const int code = sqlite3_bind_null(statement_.get(), place + 1); code != SQLITE_OK)
    throw error_of(code);
  return *this;
}

bool SqliteStatement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) {
    const std::string words = sqlite3_errmsg(file_.database_.get());
    sqlite3_reset(statement_.get());
    throw file_.error_of(code, words);
  }
  sqlite3_reset(statement_.get());
  return false;
}

void SqliteStatement::run() { static_cast<void>(step()); }

void SqliteStatement::reset() { sqlite3_reset(statement_.get()); }

bool SqliteStatement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::int64_t SqliteStatement::integer(int column) const {
  require(sqlite3_column_type(statement_.get(), column) == SQLITE_INTEGER);
  return sqlite3_column_int64(statement_.get(), column);
}

double SqliteStatement::number(int column) const {
  const int type = sqlite3_column_type(statement_.get(), column);
  require(type == SQLITE_FLOAT || type == SQLITE_INTEGER);
  return sqlite3_column_double(statement_.get(), column);
}

std::string SqliteStatement::text(int column) const {
  require(sqlite3_column_type(statement_.get(), column) == SQLITE_TEXT);
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

std::optional<double> SqliteStatement::number_or_none(int column) const {
  return is_null(column) ? std::nullopt : std::optional(number(column));
}

std::optional<std::int64_t> SqliteStatement::integer_or_none(int column) const {
  return is_null(column) ? std::nullopt : std::optional(integer(column));
}

std::optional<std::string> SqliteStatement::text_or_none(int column) const {
  return is_null(column) ? std::nullopt : std::optional(text(column));
}

void SqliteFile::Closer::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

SqliteFile::SqliteFile(const std::string& file, Opening opening)
    : name_(file), writes_(opening != Opening::read) {
  // A pipe would keep the library waiting, and a folder is worded badly by it.
  std::error_code error;
  const bool is_there = std::filesystem::exists(std::filesystem::symlink_status(file, error));
  if (!writes_ || is_there)
    if (const std::string problem = sim::why_no_input(file); !problem.empty())
      throw sim::Error(writes_ ? sim::ErrorKind::unwritable_output : sim::ErrorKind::unreadable_input,
                       problem)
          .file(file)
          .expected("a database");
  // Also for reading: what a killed writer has left can be put right by a writer alone. Where the file must
  // not be written to, the library opens it for reading.
  const int flags = SQLITE_OPEN_READWRITE | (writes_ ? SQLITE_OPEN_CREATE : 0) | SQLITE_OPEN_NOMUTEX;
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2(absolute_name(file).c_str(), &database, flags, nullptr);
  database_.reset(database);
  if (code != SQLITE_OK)
    throw error_of(code, database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(code));
  sqlite3_extended_result_codes(database, 1);
  // Of strangers' files: nothing in them is run, and no cell is larger than any of ours.
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kMaxCellBytes);
  run("PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0");  // which lock nothing
  // Where there are no locks, waiting for them is in vain. Nothing is locked yet that has_no_locks() could
  // unlock; whatever else is wrong is told below.
  if ((sqlite3_exec(database, "PRAGMA schema_version", nullptr, nullptr, nullptr) & 0xff) == SQLITE_BUSY &&
      has_no_locks(name_))
    throw error_of(SQLITE_BUSY, {});
  sqlite3_busy_timeout(database, kWait_ms);
  run("PRAGMA cache_size = -8192");
  if (opening == Opening::make)
    run("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA locking_mode = EXCLUSIVE");
  else if (writes_)
    run("PRAGMA synchronous = EXTRA");
}

void SqliteFile::run(const std::string& sql) {
  char* words = nullptr;
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, &words);
  if (code == SQLITE_OK) return;
  const std::string text = words != nullptr ? words : sqlite3_errstr(code);
  sqlite3_free(words);
  throw error_of(code, text);
}

std::int64_t SqliteFile::integer(const std::string& sql) const {
  SqliteStatement statement(*this, sql);
  if (!statement.step()) throw error_of(SQLITE_CORRUPT, "a row is missing");
  return statement.integer(0);
}

void SqliteFile::commit() {
  try {
    run("COMMIT");
  } catch (...) {
    roll_back();
    throw;
  }
}

void SqliteFile::roll_back() noexcept {
  // A full disk may have rolled it back already.
  if (sqlite3_get_autocommit(database_.get()) == 0)
    sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
}

sim::Error SqliteFile::error_of(int code, const std::string& words) const {
  switch (code & 0xff) {
    case SQLITE_NOMEM:
      throw std::bad_alloc();
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      if (has_no_locks(name_))
        return sim::Error(sim::ErrorKind::unwritable_output, "its file system has no locks for files")
            .file(name_)
            .expected("a database on a disk of this machine, or on a network disk with locks")
            .hint("an NFS server needs its lock daemon (rpc.statd)");
      return sim::Error(sim::ErrorKind::existing_output, "another process keeps this database")
          .file(name_)
          .hint("try again when it has ended");
    case SQLITE_FULL:
      return sim::Error(sim::ErrorKind::unwritable_output, "cannot be written: the disk is full")
          .file(name_)
          .hint("what was finished before is in it, and the same command goes on from there");
    case SQLITE_IOERR:
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
      if (writes_)
        return sim::Error(sim::ErrorKind::unwritable_output, "cannot be written: " + words).file(name_);
      return sim::unreadable(name_, "cannot be read: " + words);
    default:
      return sim::unreadable(name_, "is a damaged database, or none: " + words);
  }
}

std::string sqlite_version() { return sqlite3_libversion(); }

}  // namespace vegard::fit
