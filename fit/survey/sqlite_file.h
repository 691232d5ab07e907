// A SQLite database in a file: a wrapper of the SQLite library, which is included in sqlite_file.cpp alone.
//
// A database has one writer and any number of readers, each of which may be killed at any time. It uses the
// rollback journal (a file beside the database), not a write-ahead log: the latter needs memory that all
// processes share, which network file systems lack, and surveys on clusters use such file systems. Each
// transaction is on the disk, with the folder's entry, before the next begins.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "sim/base/error.h"

struct sqlite3;       // NOLINT(readability-identifier-naming): the library's own names
struct sqlite3_stmt;  // NOLINT(readability-identifier-naming)

namespace vegard::fit {

class SqliteFile;

/// A prepared statement. Parameters (`place` of bind()) and columns are counted from 0, in the order of the
/// statement. A column whose type is not the requested one is damage and throws Error(unreadable_input).
class SqliteStatement {
 public:
  SqliteStatement(const SqliteFile& file, const std::string& sql);

  SqliteStatement& bind(int place, const std::string& text);
  SqliteStatement& bind(int place, const char* text) { return bind(place, std::string(text)); }
  SqliteStatement& bind(int place, std::int64_t number);
  SqliteStatement& bind(int place, int number) { return bind(place, static_cast<std::int64_t>(number)); }
  SqliteStatement& bind(int place, double number);
  SqliteStatement& bind_null(int place);
  template <typename T>
  SqliteStatement& bind(int place, const std::optional<T>& value) {
    return value ? bind(place, *value) : bind_null(place);
  }
  /// Binds all parameters, in their order.
  template <typename... Values>
  SqliteStatement& bind_all(const Values&... values) {
    int place = 0;
    (bind(place++, values), ...);
    return *this;
  }

  /// Moves to the next row. Returns false after the last; then the statement may be bound and stepped again.
  bool step();
  /// Executes a statement that returns no rows.
  void run();
  /// Discards the remaining rows.
  void reset();

  bool is_null(int column) const;
  std::int64_t integer(int column) const;
  double number(int column) const;  ///< accepts integers too
  std::string text(int column) const;
  std::optional<double> number_or_none(int column) const;
  std::optional<std::int64_t> integer_or_none(int column) const;
  std::optional<std::string> text_or_none(int column) const;

 private:
  sim::Error error_of(int code) const;
  void require(bool is_sound) const;

  const SqliteFile& file_;
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const;
  };
  std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
};

class SqliteFile {
 public:
  enum class Opening {
    write,  ///< an empty or new file becomes a database
    read,   ///< rolls back the unfinished transaction of a killed writer first, if the file is writable
    make,   ///< a new file that no other process uses yet and that is discarded on failure: no journal, no
            ///< waiting for the disk
  };

  /// Throws sim::Error: (unreadable_input) for a file that is not a database or cannot be read,
  /// (unwritable_output) for one that cannot be written, (existing_output) while another process locks it.
  SqliteFile(const std::string& file, Opening opening);

  /// Executes one or several statements that return no rows.
  void run(const std::string& sql);

  /// Returns the first column of the only row of a query.
  std::int64_t integer(const std::string& sql) const;

  /// Calls `call` within a transaction: either all of its changes are made or none. Readers wait at most
  /// until it ends.
  template <typename Call>
  void transaction(const Call& call) {
    run("BEGIN IMMEDIATE");
    try {
      call();
    } catch (...) {
      roll_back();
      throw;
    }
    commit();
  }

  const std::string& name() const { return name_; }

 private:
  friend class SqliteStatement;
  /// Returns what corresponds to an error code of the library; throws std::bad_alloc for its lack of memory.
  sim::Error error_of(int code, const std::string& words) const;
  void commit();
  void roll_back() noexcept;

  std::string name_;
  bool writes_;
  struct Closer {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Closer> database_;
};

/// Returns the version of the library, such as "3.40.1".
std::string sqlite_version();

}  // namespace vegard::fit
