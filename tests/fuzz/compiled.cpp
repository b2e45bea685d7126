// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled environments of which bytes were changed, with checksums that fit: what is opened can be certified
// or refused, and what is certified is moved about in. The first byte tells whether checksums are made to
// fit, the second how many bytes of motions come before the image.
#include <cellwalk/environment/compiled.h>
#include <cellwalk/internal/environment/image_format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "environment/images.h"
#include "fuzz/decoder.h"
#include "fuzz/move_about.h"
#include "fuzz/targets.h"

namespace cellwalk::fuzz {
namespace {

/// Makes the checksums fit, and the length, if there is a table of sections that lie in the image.
void seal_if_possible(std::span<std::byte> image) {
  detail::Image_header header;
  if (!is_compiled(image) || image.size() < sizeof header) return;
  std::memcpy(&header, image.data(), sizeof header);
  if (header.sections > (image.size() - sizeof header) / sizeof(detail::Image_section)) return;
  for (const detail::Image_section& section : test::table_of(image))
    if (section.offset > image.size() || section.bytes > image.size() - section.offset) return;
  header.bytes = image.size();
  std::memcpy(image.data(), &header, sizeof header);
  test::seal(image);
}

template <int D>
void use(Compiled_environment<D>& opened, Decoder& in) {
  Environment<D>& environment = opened.environment;
  const std::initializer_list<Error_code> codes{Error_code::not_certified};
  if (!reads([&] { check_compiled(environment); }, codes) || !reads([&] { environment.certify(); }, codes))
    return;
  const Cell_soup<D> own = environment.soup();
  demand(environment.snapshot().cell_count() == own.cell_count(), "its soup has other cells");
  constexpr std::size_t most_motions = 4;
  move_about(environment.snapshot(), own, in, most_motions);
  environment.thaw();
  reads([&] { environment.certify(); }, {});
}

}  // namespace

void compiled(std::string_view bytes) {
  Decoder first(bytes);
  const bool is_sealed = first.flag();
  const std::size_t motions = first.byte();
  const std::string_view rest = first.rest();
  Decoder in(rest.substr(0, motions));
  const std::string_view given = rest.substr(std::min(motions, rest.size()));
  std::vector<std::byte> image(given.size());
  if (!given.empty()) std::memcpy(image.data(), given.data(), given.size());
  if (is_sealed) seal_if_possible(image);
  std::optional<Any_compiled_environment> opened;
  if (!reads([&] { opened.emplace(open_compiled_copy(image)); })) return;
  std::visit([&](auto& known) { use(known, in); }, *opened);
}

}  // namespace cellwalk::fuzz
