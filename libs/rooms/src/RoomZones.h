#pragma once

#include "RoomBuilder.h"

namespace quadmap::simulator
{
/** \name Parts of a room, with all that belongs there. What finds no place is left out. */
/** @{ */
void addDiningPlace(RoomBuilder& room);  //!< Table and chairs, things on it, a lamp above
void addWorkPlace(RoomBuilder& room);    //!< Desk, chair, screens, things on and under it
void addLounge(RoomBuilder& room);       //!< Couch, armchairs, coffee table, television
void addSleepingPlace(RoomBuilder& room);
void addKitchenRow(RoomBuilder& room);  //!< Along a wall, cupboards above
void addStorage(RoomBuilder& room);     //!< A cabinet or a bookshelf with things on and in it
/** @} */

}  // namespace quadmap::simulator
