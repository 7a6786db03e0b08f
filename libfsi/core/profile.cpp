#include "libfsi/core/profile.hpp"

#include <mpi.h>
#include <petscsys.h>

#include "libfsi/core/error.hpp"

namespace fsi {

int Profile::add(const std::string& name, const std::string& phase) {
  const std::string title = "fsi " + name;
  PetscLogEvent event = -1;
  FSI_PETSC(PetscLogEventGetId(title.c_str(), &event));
  if (event < 0) {
    PetscClassId class_id = 0;
    FSI_PETSC(PetscClassIdRegister("fsi", &class_id));
    FSI_PETSC(PetscLogEventRegister(title.c_str(), class_id, &event));
  }
  items_.push_back({phase, event, 0});
  return static_cast<int>(items_.size()) - 1;
}

std::map<std::string, Real> Profile::seconds() const {
  std::map<std::string, Real> result;
  for (const Item& item : items_) result[item.phase] += item.seconds;
  return result;
}

Profile::Call::Call(Profile& profile, int number)
    : profile_(profile), number_(number), start_(MPI_Wtime()) {
  FSI_PETSC(PetscLogEventBegin(profile_.items_[static_cast<std::size_t>(number_)].event, nullptr,
                               nullptr, nullptr, nullptr));
}

Profile::Call::~Call() {
  Item& item = profile_.items_[static_cast<std::size_t>(number_)];
  // A destructor cannot report a failed log call, and needs not.
  static_cast<void>(PetscLogEventEnd(item.event, nullptr, nullptr, nullptr, nullptr));
  item.seconds += MPI_Wtime() - start_;
}

}  // namespace fsi
