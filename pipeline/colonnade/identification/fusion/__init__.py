"""From transducers and gyroscopes to the motion of the specimen."""
