# Debian's packages only; what each is for: doc/dependencies.md.

find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Ceres 2.1 REQUIRED)
foreach(module config io serialization poses img obs maps opengl graphs tclap)
  find_package(mrpt-${module} REQUIRED)
endforeach()
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs video features2d calib3d dnn)
find_package(nlohmann_json 3.7 REQUIRED)
find_package(Threads REQUIRED)

# Cameras are read by OpenNI2 where it is installed.
find_path(OPENNI2_INCLUDE_DIR OpenNI.h PATH_SUFFIXES openni2)
find_library(OPENNI2_LIBRARY OpenNI2)
mark_as_advanced(OPENNI2_INCLUDE_DIR OPENNI2_LIBRARY)
if(OPENNI2_INCLUDE_DIR AND OPENNI2_LIBRARY)
  set(OPENNI2_FOUND TRUE)
else()
  set(OPENNI2_FOUND FALSE)
  message(STATUS "OpenNI2 not found (libopenni2-dev): the programs are built without cameras")
endif()

# Dense clouds are made with PCL where it is installed. Of VTK, which the parts that are used do not
# need, its configuration would ask for MPI and Qt.
set(CMAKE_DISABLE_FIND_PACKAGE_VTK TRUE)
find_package(PCL 1.12 QUIET COMPONENTS common kdtree search features filters segmentation)
if(NOT PCL_FOUND)
  message(STATUS "PCL not found (libpcl-dev): the programs are built without dense clouds")
endif()
