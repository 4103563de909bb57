// The ring between two cylinders of radius 0.5 and 1 m; `./fpi mesh taylor_couette` makes taylor_couette.msh.
DefineConstant[ size = 1 ];  // factor of all sizes
SetFactory("OpenCASCADE");
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeMax = 0.08 * size;

Disk(1) = {0, 0, 0, 1};
Disk(2) = {0, 0, 0, 0.5};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };

Physical Surface("fluid") = {3};
Physical Curve("inner") = Curve In BoundingBox {-0.6, -0.6, -1, 0.6, 0.6, 1};
Physical Curve("outer") = {Boundary{ Surface{3}; }};
Physical Curve("outer") -= Curve In BoundingBox {-0.6, -0.6, -1, 0.6, 0.6, 1};
