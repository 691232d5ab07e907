// A SQLite database as a file: the front of the library, which is compiled in sqlite_file.cpp alone.
//
// One writer and any number of readers, which may be killed at any time. The journal is the old one beside
// the file, no write-ahead log: that needs memory shared between all who read and write, which network file
// systems do not have, and surveys of clusters lie on such. Each transaction is on the disk, with the
// folder's entry, before the next begins.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

struct sqlite3;       // NOLINT(readability-identifier-naming): the library's own names
struct sqlite3_stmt;  // NOLINT(readability-identifier-naming)

namespace vegard::fit {

class SqliteFile;

/// A prepared statement. Places of `bind` and columns are counted from 0, in the order of the statement. A
/// column that has another type than is asked for is damage: Error(unreadable_input).
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

  /// The next row; false after the last, and the statement may be bound and stepped again.
  bool step();
  /// step() of what gives no row.
  void run();
  /// Gives up the rows that are left.
  void reset();

  bool is_null(int column) const;
  std::int64_t integer(int column) const;
  double number(int column) const;  ///< a whole number is one as well
  std::string text(int column) const;
  std::optional<double> number_or_none(int column) const;
  std::optional<std::int64_t> integer_or_none(int column) const;
  std::optional<std::string> text_or_none(int column) const;

 private:
  void fail(int code) const;
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
    read,   ///< what a killed writer has left is put right first, where the file may be written to
    make,   ///< a new file that nobody else sees yet, and that is thrown away if this fails: no journal, no
            ///< waiting for disks
  };

  /// Throws sim::Error: (unreadable_input) for what is no database or cannot be read, (unwritable_output) for
  /// what cannot be written, (existing_output) while another process keeps it.
  SqliteFile(const std::string& file, Opening opening);

  /// One statement or several, without rows.
  void run(const std::string& sql);

  /// The first column of the only row.
  std::int64_t integer(const std::string& sql) const;

  /// All of `call`, or nothing of it. The file's readers wait no longer than for its end.
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
  /// Throws what a result of the library means for whoever uses the file.
  [[noreturn]] void fail(int code, const std::string& words) const;
  void commit();
  void roll_back() noexcept;

  std::string name_;
  bool writes_;
  struct Closer {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Closer> database_;
};

/// Of the library, as "3.40.1".
std::string sqlite_version();

}  // namespace vegard::fit
