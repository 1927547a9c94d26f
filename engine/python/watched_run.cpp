// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A long call that lets Python go on, tells how far it is, and ends at Ctrl-C.
#include "engine/python/watched_run.h"

#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace py = pybind11;

namespace mwmesh::python {
namespace {

constexpr std::chrono::milliseconds kLook{100};

// The interpreter's lock guards both.
int lockless = 0;               ///< how many WithoutLock there are
std::thread::id ending_thread;  ///< what ends the interpreter; may still run what it likes

void refuse_at_end() {
  if (ending_thread == std::thread::id{} || ending_thread == std::this_thread::get_id()) return;
  throw Error(ErrorKind::kCancelled, "the interpreter ends, and this call with it");
}

void end_runs() {
  ending_thread = std::this_thread::get_id();
  while (lockless > 0) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    const py::gil_scoped_release no_lock;
    std::this_thread::sleep_for(kLook / 10);
  }
}

/// Work that runs in a thread of its own.
class Watched {
 public:
  explicit Watched(const std::function<void(const Hooks&)>& work)
      : thread_([this, &work] { run(work); }) {}
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

  /// Cancels the work unless it has ended.  REQUIRES: without the interpreter's lock.
  ~Watched() {
    cancelled_ = true;
    thread_.join();
  }

  /// Waits a moment.  Returns whether the work has ended.
  [[nodiscard]] bool has_ended() {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, kLook, [this] { return is_over_; });
  }

  /// Returns the latest progress, once.
  [[nodiscard]] std::optional<Progress> news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, std::nullopt);
  }

  /// Returns the warnings that came since the last call.
  [[nodiscard]] std::vector<std::string> warnings() {
    const std::lock_guard lock(mutex_);
    return std::exchange(warnings_, {});
  }

  /// REQUIRES: the work has ended.
  [[nodiscard]] std::exception_ptr error() const { return error_; }

 private:
  void run(const std::function<void(const Hooks&)>& work) {
    const Hooks hooks{.progress =
                          [this](const Progress& at) {
                            const std::lock_guard lock(mutex_);
                            news_ = at;
                          },
                      .cancel = [this] { return cancelled_.load(); },
                      .warn =
                          [this](const std::string& line) {
                            const std::lock_guard lock(mutex_);
                            warnings_.push_back(line);
                          }};
    std::exception_ptr error;
    try {
      work(hooks);
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    error_ = error;
    is_over_ = true;
    ended_.notify_all();
  }

  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::optional<Progress> news_;
  std::vector<std::string> warnings_;
  std::exception_ptr error_;
  std::thread thread_;  ///< last, as it uses the others
};

void warn(const std::vector<std::string>& lines) {
  constexpr py::ssize_t kCaller = 3;  // of mwmesh.mesh(), which calls what calls the core
  for (const std::string& line : lines) {
    if (PyErr_WarnEx(PyExc_RuntimeWarning, line.c_str(), kCaller) != 0) {
      throw py::error_already_set();
    }
  }
}

void tell(const py::object& progress, const std::optional<Progress>& news) {
  if (!news || progress.is_none()) return;
  progress(news->done, news->total, news->seconds_left);
}

}  // namespace

WithoutLock::Counted::Counted() {
  refuse_at_end();
  ++lockless;
}

WithoutLock::Counted::~Counted() {
  --lockless;
}

void end_runs_at_exit() {
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_runs));
  // A child of os.fork() has one thread, whatever ran in its parent.
  py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") =
                                                         py::cpp_function([] { lockless = 0; }));
}

void run_watched(const py::object& progress, const std::function<void(const Hooks&)>& work) {
  std::exception_ptr error;
  {
    const WithoutLock no_gil;
    Watched watched(work);
    while (!watched.has_ended()) {
      const std::optional<Progress> news = watched.news();
      const std::vector<std::string> warnings = watched.warnings();
      const py::gil_scoped_acquire gil;
      refuse_at_end();
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      warn(warnings);
      tell(progress, news);
    }
    error = watched.error();
    const std::optional<Progress> news = watched.news();
    const std::vector<std::string> warnings = watched.warnings();
    const py::gil_scoped_acquire gil;
    if (!error) warn(warnings);
    if (!error) tell(progress, news);
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace mwmesh::python
