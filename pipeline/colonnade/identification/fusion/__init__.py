"""From transducers, gyroscopes and accelerometers to the motion of the specimen."""
