"""What is tested and when: the paper's programme, its kinds of test, their amplitudes and days."""
