// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A place in a store of chunks: a path of the file system, or an address of a server.  Readers of
// stores see places only, and do not know which of the two they read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/file/source/byte_source.h"

namespace mw::io {

/// Maps names to bytes.  Thread safety: all members may be called from many threads.
class Store {
 public:
  virtual ~Store() = default;

  /// Opens what is read as a whole; null when there is nothing of this name.  max is the most bytes
  /// that it may have: a server's body is refused while it arrives if it has more, but the caller
  /// must check the size of a file.
  /// ERRORS: mw::Error(kInput) naming it when it is there and cannot be read, or has more bytes;
  /// kResource when a server does not answer.
  [[nodiscard]] virtual std::unique_ptr<ByteSource> open(const std::string& name,
                                                         std::uint64_t max) const = 0;
  /// Opens what is read in parts, of any size; null when there is nothing of this name.
  /// ERRORS: those of open().
  [[nodiscard]] virtual std::unique_ptr<ByteSource> open_parts(const std::string& name) const = 0;
  /// Opens [offset, offset + size) of what is there; errors call it label.
  /// ERRORS: mw::Error(kInput) when it is not there, or has fewer bytes; the latter may come only
  /// when they are read.
  [[nodiscard]] virtual std::shared_ptr<const ByteSource> open_part(const std::string& name,
                                                                    std::uint64_t offset,
                                                                    std::uint64_t size,
                                                                    std::string label) const = 0;
  /// Returns how many of that many bytes open() may hold in memory.
  [[nodiscard]] virtual std::uint64_t held_bytes(std::uint64_t max) const = 0;
  /// Whether there is a file of this name.  ERRORS: those of open().
  [[nodiscard]] virtual bool has_file(const std::string& name) const = 0;
  /// Whether there is a document of this name that tells of a store.  Where a server refuses to say
  /// so, it is taken for absent, since some refuse whatever they do not have; what is found then
  /// decides, and refusal() explains why nothing was.  ERRORS: others than that, as open().
  [[nodiscard]] virtual bool has_document(const std::string& name) const { return has_file(name); }
  /// Returns what an error says of the first document that a server refused, with the way out;
  /// empty when there is none.
  [[nodiscard]] virtual std::string refusal() const { return {}; }
  /// Whether there is a folder of this name; nothing where the store has no folders.
  [[nodiscard]] virtual std::optional<bool> has_folder(const std::string& name) const = 0;
  /// Returns the names of folders in a folder, sorted; nothing where the store cannot list them.
  [[nodiscard]] virtual std::optional<std::vector<std::string>> folders_in(
      const std::string& name) const = 0;
  /// Whether looking for thousands of files takes little time.
  [[nodiscard]] virtual bool is_near() const = 0;
  /// Returns the name of what is called `more` below a name.
  [[nodiscard]] virtual std::string below(const std::string& name, std::string_view more) const = 0;
  /// Returns the name of the folder that holds it, and its own in there; nothing at the top.
  [[nodiscard]] virtual std::optional<std::pair<std::string, std::string>> above(
      const std::string& name) const = 0;
};

/// A name with its store.  Store describes the members that call one of its own.
class Place {
 public:
  /// A path of the file system; a '/' at its end is left out.
  Place(const std::filesystem::path& path);  // NOLINT(google-explicit-constructor)
  Place(std::shared_ptr<const Store> store, std::string name)
      : store_(std::move(store)), name_(std::move(name)) {}

  /// Returns the path, or the address.
  [[nodiscard]] const std::string& string() const { return name_; }
  /// Returns the part behind the last '/'.
  [[nodiscard]] std::string last_part() const;
  /// Returns the place below it; in the file system an absolute path gives that path itself.
  [[nodiscard]] Place operator/(std::string_view more) const {
    return {store_, store_->below(name_, more)};
  }
  /// Returns the place with more letters at the end of its name.
  [[nodiscard]] Place operator+(std::string_view more) const {
    return {store_, name_ + std::string(more)};
  }
  /// Returns the folder that holds it and its name in there, or nothing at the top.  Links are not
  /// followed.
  [[nodiscard]] std::optional<std::pair<Place, std::string>> parent() const;

  /// Opens what is there, as open() and open_parts() of the store do.
  [[nodiscard]] std::unique_ptr<ByteSource> open_if_there(std::uint64_t max) const {
    return store_->open(name_, max);
  }
  [[nodiscard]] std::unique_ptr<ByteSource> open_parts_if_there() const {
    return store_->open_parts(name_);
  }
  [[nodiscard]] std::shared_ptr<const ByteSource> open_part(std::uint64_t offset,
                                                            std::uint64_t size,
                                                            std::string label) const {
    return store_->open_part(name_, offset, size, std::move(label));
  }
  [[nodiscard]] std::uint64_t held_bytes(std::uint64_t max) const {
    return store_->held_bytes(max);
  }
  [[nodiscard]] bool is_file() const { return store_->has_file(name_); }
  [[nodiscard]] bool is_document() const { return store_->has_document(name_); }
  [[nodiscard]] std::string refusal() const { return store_->refusal(); }
  /// Returns the way out of an error about documents that are missing: past the refusal, if there
  /// is one, else the usual one.
  [[nodiscard]] std::string refusal_or(const std::string& usual) const {
    const std::string refused = refusal();
    return refused.empty() ? usual : refused;
  }
  [[nodiscard]] std::optional<bool> is_folder() const { return store_->has_folder(name_); }
  [[nodiscard]] std::optional<std::vector<std::string>> folders() const {
    return store_->folders_in(name_);
  }
  [[nodiscard]] bool is_near() const { return store_->is_near(); }

 private:
  std::shared_ptr<const Store> store_;
  std::string name_;
};

}  // namespace mw::io
