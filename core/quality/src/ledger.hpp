#pragma once

#include <vector>

#include "qmcf/quality/quality.hpp"
#include "structure.hpp"

namespace qmcf::quality {

/// The ledger of a mesh whose structure is known. Elements that are not usable take no part.
IndexLedger balance(const std::vector<Element>& elements, const std::vector<std::uint8_t>& usable,
                    const EdgeTable& table);

}  // namespace qmcf::quality
