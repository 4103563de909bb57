// The channel of DFG 2D-1 with its cylinder; `gmsh -2 cylinder.geo` makes cylinder.msh.
SetFactory("OpenCASCADE");
Mesh.MshFileVersion = 4.1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

radius = 0.05;
Rectangle(1) = {0, 0, 0, 2.2, 0.41};
Disk(2) = {0.2, 0.2, 0, radius};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };

// Size: 128 edges round the cylinder, growing with the distance from it.
circle() = Curve In BoundingBox {0.14, 0.14, -1, 0.26, 0.26, 1};
Field[1] = Distance;
Field[1].CurvesList = {circle()};
Field[1].Sampling = 400;
Field[2] = MathEval;
Field[2].F = "min(0.0024 + 0.11*F1, 0.035)";
Background Field = 2;

Physical Surface("fluid") = {3};
Physical Curve("cylinder") = {circle()};
Physical Curve("inlet") = Curve In BoundingBox {-0.01, -0.01, -1, 0.01, 0.42, 1};
Physical Curve("outlet") = Curve In BoundingBox {2.19, -0.01, -1, 2.21, 0.42, 1};
Physical Curve("walls") = {Curve In BoundingBox {-0.01, -0.01, -1, 2.21, 0.01, 1},
                           Curve In BoundingBox {-0.01, 0.40, -1, 2.21, 0.42, 1}};
