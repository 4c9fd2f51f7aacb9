#pragma once

#include "qmcf/field/connection.hpp"
#include "qmcf/field/cross_field.hpp"

namespace qmcf {

/// Fills CrossField::corner and CrossField::extraTurn from CrossField::cross.
void fillCorners(const Patch& patch, const Connection& connection, CrossField& field);

}  // namespace qmcf
