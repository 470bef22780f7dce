# Debian's packages only; what each is for: doc/dependencies.md.

find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Ceres 2.1 REQUIRED)
foreach(module config io serialization poses img obs maps opengl graphs tclap)
  find_package(mrpt-${module} REQUIRED)
endforeach()
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs video features2d calib3d dnn)
find_package(nlohmann_json 3.7 REQUIRED)
find_package(Threads REQUIRED)
