// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Serves a folder on this machine; only folder_server.cpp sees the library that speaks HTTP.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

struct MHD_Daemon;

namespace mw::cli {

struct FolderService;

/// Gives files of a folder, and parts of them, to programs on this machine: it listens on the
/// loopback alone.  It says by CORS that pages of one origin may read, and refuses requests for
/// another host than this machine, as a page can give its own name this machine's address.
class FolderServer {
 public:
  /// Listens on the port; 0 is any that is free.  origin is that of the pages (io::origin_of()).
  /// ERRORS: mw::Error(kUsage) when the port is in use or not allowed; kResource when the system
  /// gives no socket.
  FolderServer(const std::filesystem::path& folder, std::uint16_t port, std::string origin);
  ~FolderServer();
  FolderServer(const FolderServer&) = delete;
  FolderServer& operator=(const FolderServer&) = delete;

  /// Returns where it listens: "http://127.0.0.1:PORT".
  [[nodiscard]] std::string address() const;
  /// Answers all connections in this thread, for as long as the process lives.
  /// ERRORS: mw::Error(kResource) when the system takes the socket away.
  [[noreturn]] void serve();

 private:
  std::unique_ptr<FolderService> service_;
  std::unique_ptr<MHD_Daemon, void (*)(MHD_Daemon*)> daemon_;
};

}  // namespace mw::cli
