// SPDX-License-Identifier: LGPL-3.0-or-later
// The environment variables of mpirun, and the module of MPI that is loaded if they are set.
#include <cellwalk/internal/io/module.h>
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/internal/ranks/ranks.h>

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>
#include <utility>

#include "transport.h"

namespace cellwalk {
namespace {

/// A number that mpirun of Open MPI sets in the environment; otherwise 0.
long number_of_mpirun(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? 0 : std::strtol(text, nullptr, 10);
}

const Transport_module* description(void* entry) { return reinterpret_cast<Transport_module_entry>(entry)(); }

/// The module of MPI; its function is null, with the reason, if there is none.
const io::Module_function& mpi_module() {
  static const io::Module_function entry =
      CELLWALK_HAS_MPI ? io::load_module("libcellwalk_mpi.so", transport_module_entry,
                                         [](void* found) { return description(found)->cellwalk; })
                       : io::Module_function{};
  return entry;
}

}  // namespace

Ranks::Ranks() = default;
Ranks::Ranks(std::unique_ptr<Transport> transport) : transport_(std::move(transport)) {}
Ranks::Ranks(Ranks&&) noexcept = default;
Ranks& Ranks::operator=(Ranks&&) noexcept = default;
Ranks::~Ranks() = default;

Ranks Ranks::join() {
  const long size = number_of_mpirun("OMPI_COMM_WORLD_SIZE");
  if (size <= 1) return {};
  if (!CELLWALK_HAS_MPI)
    throw Error(Error_code::other,
                fmt::format("this build lacks MPI, which shares work among the {} processes of mpirun: "
                            "install libboost-mpi-dev and libopenmpi-dev and configure with "
                            "-DCELLWALK_WITH_MPI=ON, or start it without mpirun",
                            size));
  const io::Module_function& entry = mpi_module();
  if (entry.function == nullptr)
    throw Error(
        Error_code::other,
        fmt::format("MPI, which shares work among the {} processes of mpirun, cannot be loaded ({}): install "
                    "cellwalk-mpi, or name the folder of its module in CELLWALK_READERS",
                    size, entry.problem));
  return Ranks(description(entry.function)->join());
}

std::size_t Ranks::rank() const { return transport_ ? transport_->rank() : 0; }
std::size_t Ranks::size() const { return transport_ ? transport_->size() : 1; }

std::vector<std::string> Ranks::gather(std::string bytes) {
  std::vector<std::string> all;
  gather(std::move(bytes), [&all](std::string of_rank) { all.push_back(std::move(of_rank)); });
  return all;
}

void Ranks::gather(std::string bytes, const std::function<void(std::string)>& use) {
  if (!is_first()) return transport_->send(0, {Message_kind::part, std::move(bytes)});
  use(std::move(bytes));
  for (std::size_t from = 1; from < size(); ++from) {
    Message message = transport_->receive(from);
    if (message.kind == Message_kind::failure) {
      detail::Byte_reader failure(message.bytes);
      const auto code = failure.next<Error_code>();
      throw Error(code, failure.next<std::string>());
    }
    use(std::move(message.bytes));
  }
}

std::string Ranks::broadcast(std::string bytes) {
  return transport_ ? transport_->broadcast(std::move(bytes)) : bytes;
}

bool Ranks::shares_node() const { return transport_ && transport_->size_of_node() > 1; }
bool Ranks::is_first_on_node() const { return !transport_ || transport_->rank_on_node() == 0; }

std::string Ranks::broadcast_on_node(std::string bytes) {
  return transport_ ? transport_->broadcast_on_node(std::move(bytes)) : bytes;
}

void Ranks::fail(Error_code code, const std::string& message) {
  if (!transport_) return;
  if (is_first()) transport_->end(static_cast<int>(code));
  detail::Byte_writer failure;
  failure(code, message);
  transport_->send(0, {Message_kind::failure, failure.message()});
  transport_->receive(0);  // the farewell; a first rank that takes notice ends this process instead
  transport_->drop_sent();
}

void Ranks::leave() {
  if (!transport_) return;
  if (!is_first()) {
    transport_->receive(0);
    return;
  }
  for (std::size_t to = 1; to < size(); ++to) transport_->send(to, {Message_kind::farewell, {}});
}

bool is_later_rank() {
  return number_of_mpirun("OMPI_COMM_WORLD_SIZE") > 1 && number_of_mpirun("OMPI_COMM_WORLD_RANK") > 0;
}

std::string mpi_version() {
  const io::Module_function& entry = mpi_module();
  return entry.function == nullptr ? std::string{} : description(entry.function)->library();
}

}  // namespace cellwalk
