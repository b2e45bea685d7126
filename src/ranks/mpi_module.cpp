// SPDX-License-Identifier: LGPL-3.0-or-later
// The module of MPI: Boost.MPI starts and ends it. The calls that wait are those of MPI that do not block, so
// that a rank that waits leaves the processor to others.
#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>
#include <boost/mpi/exception.hpp>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <stdexcept>
#include <thread>

#include "transport.h"

namespace cellwalk {
namespace {

constexpr int tag = 1;
constexpr std::size_t most_sent = 64;                        // messages on their way at a time
constexpr std::size_t longest_piece = std::size_t{1} << 28;  // bytes; MPI counts in int
// The number of times that a waiting rank yields before it sleeps, first for a short time, at last for a long
// one.
constexpr int yields = 20;
constexpr std::chrono::microseconds shortest_sleep{50}, longest_sleep{1000};

void succeed(int code) {
  if (code != MPI_SUCCESS) throw boost::mpi::exception("MPI", code);
}

boost::mpi::communicator ranks_of_node(const boost::mpi::communicator& world) {
  MPI_Comm node = MPI_COMM_NULL;
  succeed(MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, world.rank(), MPI_INFO_NULL, &node));
  return {node, boost::mpi::comm_take_ownership};
}

class Mpi final : public Transport {
 public:
  Mpi() : environment_(boost::mpi::threading::funneled, abort_on_exception), node_(ranks_of_node(world_)) {}
  ~Mpi() override {
    try {
      while (!sent_.empty()) wait_for_first();
    } catch (...) {  // the program ends
    }
  }

  std::size_t rank() const override { return static_cast<std::size_t>(world_.rank()); }
  std::size_t size() const override { return static_cast<std::size_t>(world_.size()); }

  void send(std::size_t to, Message message) override {
    while (sent_.size() >= most_sent) wait_for_first();
    Sent& sent = sent_.emplace_back();
    sent.bytes = std::move(message.bytes);
    sent.head = {sent.bytes.size(), message.kind};
    start(sent, to, reinterpret_cast<const char*>(&sent.head), sizeof sent.head);
    for (std::size_t begin = 0; begin < sent.bytes.size(); begin += longest_piece)
      start(sent, to, sent.bytes.data() + begin, std::min(longest_piece, sent.bytes.size() - begin));
  }

  void drop_sent() override {
    for (Sent& sent : sent_)
      for (MPI_Request& request : sent.requests)
        if (request != MPI_REQUEST_NULL) {
          succeed(MPI_Cancel(&request));
          succeed(MPI_Request_free(&request));
        }
    sent_.clear();
  }

  Message receive(std::size_t from) override {
    Head head;
    receive_piece(from, reinterpret_cast<char*>(&head), sizeof head);
    Message message{head.kind, std::string(head.length, '\0')};
    for (std::size_t begin = 0; begin < head.length; begin += longest_piece)
      receive_piece(from, message.bytes.data() + begin, std::min(longest_piece, head.length - begin));
    return message;
  }

  std::string broadcast(std::string bytes) override { return broadcast(std::move(bytes), world_); }
  std::string broadcast_on_node(std::string bytes) override { return broadcast(std::move(bytes), node_); }
  std::size_t rank_on_node() const override { return static_cast<std::size_t>(node_.rank()); }
  std::size_t size_of_node() const override { return static_cast<std::size_t>(node_.size()); }

  [[noreturn]] void end(int exit_code) override {
    boost::mpi::environment::abort(exit_code);
    std::abort();  // not reached
  }

 private:
  static constexpr bool abort_on_exception = false;

  /// The head before the bytes of a message.
  struct Head {
    std::uint64_t length = 0;
    Message_kind kind = Message_kind::part;
  };
  /// A message on its way, which must not move.
  struct Sent {
    Head head;
    std::string bytes;
    std::deque<MPI_Request> requests;
  };

  /// Sent synchronously: a receiver that is slower holds the sender back.
  void start(Sent& sent, std::size_t to, const char* bytes, std::size_t length) {
    MPI_Request& request = sent.requests.emplace_back();
    succeed(
        MPI_Issend(bytes, static_cast<int>(length), MPI_BYTE, static_cast<int>(to), tag, world_, &request));
  }

  void receive_piece(std::size_t from, char* bytes, std::size_t length) {
    MPI_Request request;
    succeed(
        MPI_Irecv(bytes, static_cast<int>(length), MPI_BYTE, static_cast<int>(from), tag, world_, &request));
    wait(request);
  }

  std::string broadcast(std::string bytes, const boost::mpi::communicator& among) const {
    std::uint64_t length = bytes.size();
    broadcast_piece(reinterpret_cast<char*>(&length), sizeof length, among);
    bytes.resize(length);
    for (std::size_t begin = 0; begin < length; begin += longest_piece)
      broadcast_piece(bytes.data() + begin, std::min(longest_piece, length - begin), among);
    return bytes;
  }

  void broadcast_piece(char* bytes, std::size_t length, const boost::mpi::communicator& among) const {
    MPI_Request request;
    succeed(MPI_Ibcast(bytes, static_cast<int>(length), MPI_BYTE, 0, among, &request));
    wait(request);
  }

  void wait_for_first() {
    for (MPI_Request& request : sent_.front().requests) wait(request);
    sent_.pop_front();
  }

  void wait(MPI_Request& request) const {
    std::chrono::microseconds sleep = shortest_sleep;
    for (int tries = 0;; ++tries) {
      int done = 0;
      succeed(MPI_Test(&request, &done, MPI_STATUS_IGNORE));
      if (done != 0) return;
      if (tries < yields) {
        sched_yield();
        continue;
      }
      std::this_thread::sleep_for(sleep);
      sleep = std::min(2 * sleep, longest_sleep);
    }
  }

  boost::mpi::environment environment_;
  boost::mpi::communicator world_, node_;
  std::deque<Sent> sent_;
};

std::string library() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  succeed(MPI_Get_library_version(text, &length));
  const std::string whole(text, static_cast<std::size_t>(length));  // "Open MPI v4.1.4, package: ..."
  const std::size_t begin = whole.find(" v") + 2, end = whole.find(',');
  return whole.substr(begin, end - begin);
}

std::unique_ptr<Transport> join() { return std::make_unique<Mpi>(); }

constexpr Transport_module module{CELLWALK_VERSION, library, join};

}  // namespace
}  // namespace cellwalk

extern "C" const cellwalk::Transport_module* cellwalk_transport_module();
extern "C" __attribute__((visibility("default"))) const cellwalk::Transport_module*
cellwalk_transport_module() {
  return &cellwalk::module;
}
