// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Serves a folder on this machine; only folder_server.cpp sees the library that speaks HTTP.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "engine/cli/serve/served_folder.h"

struct MHD_Daemon;

namespace mw::cli {

/// Gives files of a folder, and parts of them, to pages from anywhere that a browser on this
/// machine shows: it listens on the loopback alone, and says by CORS that any page may read.
class FolderServer {
 public:
  /// Listens on the port; 0 is any that is free.
  /// ERRORS: mw::Error(kUsage) when the port is in use or not allowed; kResource when the system
  /// gives no socket.
  FolderServer(const std::filesystem::path& folder, std::uint16_t port);
  FolderServer(const FolderServer&) = delete;
  FolderServer& operator=(const FolderServer&) = delete;

  /// Returns where it listens: "http://127.0.0.1:PORT".
  [[nodiscard]] std::string address() const;
  /// Answers all connections in this thread, for as long as the process lives.
  /// ERRORS: mw::Error(kResource) when the system takes the socket away.
  [[noreturn]] void serve();

 private:
  ServedFolder folder_;
  std::unique_ptr<MHD_Daemon, void (*)(MHD_Daemon*)> daemon_;
};

}  // namespace mw::cli
