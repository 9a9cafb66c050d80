#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "hexfield/map/corner_map.hpp"

/// Small values from rank 0 to all ranks. All collective.
namespace hexfield {

int rank_of(MPI_Comm comm);
void broadcast(MPI_Comm comm, double& value);
void broadcast(MPI_Comm comm, int& value);
void broadcast(MPI_Comm comm, bool& value);
void broadcast(MPI_Comm comm, std::vector<double>& values);
void broadcast(MPI_Comm comm, std::string& text);
void broadcast(MPI_Comm comm, std::vector<Vec3>& places);
void broadcast(MPI_Comm comm, MapReport& report);

}  // namespace hexfield
